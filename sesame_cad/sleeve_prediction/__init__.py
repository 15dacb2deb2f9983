"""What the sleeves of a specification do to their beams: forces, states, previews, chains."""
