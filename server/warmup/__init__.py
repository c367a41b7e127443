"""What is compiled, or loaded, before somebody asks for it."""
