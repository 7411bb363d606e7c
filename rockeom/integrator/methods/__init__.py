"""Methods of integration: coefficients, and the text of a step."""
