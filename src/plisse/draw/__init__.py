"""Pictures and drawings: documents between geometry and file formats."""
