"""Images to points, points to poses, views to intrinsics.

Conventions (docs/conventions.md): metres and radians, pixel (0, 0) is the centre of the top-left pixel,
`T_cam_board` maps board coordinates into the camera frame, arrays are float64 in C order.
"""
