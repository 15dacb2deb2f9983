"""The commands, one a module; heavy imports stand in the functions that need them."""
