"""Templates, style sheets, fonts and scripts of certificates, of the overview and of the workbench."""
