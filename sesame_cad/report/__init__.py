"""One page that shows a design, and opens in a browser without a network."""
