"""The commands, a module each: `describe` gives a parser its arguments and the function that runs it."""
