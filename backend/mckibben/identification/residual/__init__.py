"""Analysis of residuals: profiles over the variables, noise, and remaining structure."""
