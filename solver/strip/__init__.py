"""A beam strip held bent by a shorter strip, and the couples of sleeves that snap it through."""
