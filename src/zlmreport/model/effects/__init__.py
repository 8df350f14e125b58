"""What effects are, and an axis as their sum."""
