"""A virtual camera and what stands before it: the normal way to develop, to test and to show the service.

Pictures are made from a known truth, so that a result can be judged against it. Not here: anything that
production code needs to calibrate; the core never imports this package.
"""
