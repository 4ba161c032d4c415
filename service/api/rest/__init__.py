"""The REST resources, one file each, with their request and response models at the top."""
