"""Physics that measurements of length rest on: the refractive index of air, the reference temperature."""
