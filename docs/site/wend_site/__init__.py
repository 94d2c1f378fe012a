"""What makes the site out of the repository: pages of its documents, of the program's options and of the interfaces."""
