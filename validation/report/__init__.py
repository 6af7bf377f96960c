"""Evidence on paper: figures, tables, numbers and the page that holds them."""
