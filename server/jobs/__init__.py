"""Work that outlives a request: state machine, store, engine, and the worker process. No web in here."""
