"""What can be made of an exact structure: motion (§2.5), offsets and plates (§2.4), parallel meshes (§2.3), strips."""
