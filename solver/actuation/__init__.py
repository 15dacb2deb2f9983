"""What a loop does when its wire is heated: transformation, heat, shape, force and load."""
