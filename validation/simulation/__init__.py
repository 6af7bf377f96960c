"""Problems solved by either method, for all that use them."""
