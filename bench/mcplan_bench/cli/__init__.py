"""The verbs `bench` and `reproduce` of the command `mcplan`."""
