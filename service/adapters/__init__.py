"""One file per outside thing, named `<port>_<kind>`; use cases see only the Protocols of `service.ports`."""
