"""How results read: values, uncertainties, a fitted model, a diagnosis, as texts that doors only lay out."""
