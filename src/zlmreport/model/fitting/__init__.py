"""From readings to parameters: the scatter, the fit, and how sure it is."""
