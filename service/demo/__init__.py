"""The demo: the service is started as a user starts it, and virtual vehicles go through it over HTTP.

Here: a customer of the whole service, with the simulator as its camera. Not here: anything the service needs.
"""
