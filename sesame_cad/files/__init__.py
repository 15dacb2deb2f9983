"""Files that leave the program, and the readers that check them."""
