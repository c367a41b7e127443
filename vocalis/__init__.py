"""Around the core: command line, server, page, studies and benchmarks."""
