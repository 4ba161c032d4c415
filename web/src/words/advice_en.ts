// What each reason of a gate says, in English: what is good, what is wrong, what to do. The codes are the core's.
import type { About, Advice } from "./advice";

export const adviceEn = {
  wrong_target: {
    good: "No image shows another board than the declared one.",
    bad: ({ views }: About) => `Another board than the declared one is in: ${views}.`,
    remedy: "Use the declared board, or declare the one that is used.",
  },
  refused_images: {
    good: "Every image could be used.",
    bad: ({ views }: About) => `Not used: ${views}.`,
    remedy: "Take those images again or leave them out.",
  },
  facing: {
    good: "The board faces the camera in every view.",
    bad: ({ views }: About) => `The solution shows the back of the board in: ${views}.`,
    remedy: "Take that image again; if it is mirrored, switch off mirroring in the camera.",
  },
  nearest_corner: {
    good: "The board is in front of the camera in every view.",
    bad: ({ views }: About) => `The solution puts the board behind the camera in: ${views}.`,
    remedy: "Take that image again.",
  },
  parity_separation: {
    good: "Dark and bright squares are clearly apart in every view.",
    bad: ({ views }: About) => `Dark and bright squares are hard to tell apart in: ${views}.`,
    remedy: "Light the board evenly, without reflections, and check that it is the declared one.",
  },
  contrast: {
    good: "The contrast is sufficient in every view.",
    bad: ({ views }: About) => `Dark and bright squares differ too little in: ${views}.`,
    remedy: "Give more light or a longer exposure.",
  },
  saturated_share: {
    good: "Hardly any bright square is saturated.",
    bad: ({ views }: About) => `Bright squares are saturated, which hides how the light fell: ${views}.`,
    remedy: "Dim the lamp, shade the window or shorten the exposure, then take it again.",
  },
  edge_width_px: {
    good: "Every view is sharp.",
    bad: ({ views }: About) => `Blurred: ${views}.`,
    remedy: ({ views }: About) =>
      `Take again: ${views}. Hold the board still, shorten the exposure, or keep it further away.`,
  },
  blurred_lens: {
    good: "Every view is sharp.",
    bad: ({ fact }: About) => `${fact("count")} of ${fact("of")} views are blurred.`,
    remedy: "Focus the lens, then take the views again.",
  },
  quadrant_ratio: {
    good: "All quadrants are as sharp as the centre.",
    bad: ({ fact }: About) =>
      `The image is softer ${fact("quadrant").replace("-", " ")} than in its centre: the lens is tilted or decentred.`,
    remedy: "Check how the lens is mounted and focused.",
  },
  missing_poses: {
    good: "Every prescribed pose was taken.",
    bad: ({ poses }: About) => `Not taken: ${poses}.`,
    remedy: "Take a picture at each of these poses.",
  },
  early_finish: {
    good: ({ fact }: About) =>
      `${fact("taken")} poses proved the required accuracy; ${fact("not_needed")} prescribed ones were not needed.`,
  },
  match_px: {
    good: "Every view lies on its prescribed pose.",
    bad: ({ views }: About) =>
      views === "" ? "No view lies on its prescribed pose." : `Too far from the prescribed pose: ${views}.`,
    remedy: "Take it again, closer to the pose that is shown.",
  },
  view_separation_px: {
    good: "No view is there twice.",
    bad: ({ views }: About) => `These show the board in the same place and tell no more than one: ${views}.`,
    remedy: "Leave one of them out, and move the board between pictures.",
  },
  image_coverage: {
    good: "The share of the image in which corners were seen; the calibration is valid there only.",
  },
  coverage: {
    good: "The views cover the working zone.",
    bad: "Parts of the working zone were never seen.",
    remedy: "Add views with the board towards the border of the image.",
  },
  rms_px: {
    good: "Board, lens model and corners agree.",
    bad: "The corners do not fit the model.",
    remedy:
      "Check that all images are of one camera and unscaled, that the board is the declared one, rigid and flat, and that nothing moved while the pictures were taken.",
  },
  rms_no_optimum: {
    good: "Board, lens model and corners agree.",
    bad: "The corners do not fit the model.",
    remedy: ({ fact }: About) =>
      `See the model gate first: the lens model ${fact("lens")} may not describe this lens.`,
  },
  rms_bent_board: {
    good: "Board, lens model and corners agree.",
    bad: "The corners do not fit the model.",
    remedy: ({ share }: About) =>
      `The residuals repeat with the corners of the board, which is probably not flat (bent by about ${share("bend")} of a square). Mount the pattern on a rigid, flat plate.`,
  },
  rms_other_lens: {
    good: "Board, lens model and corners agree.",
    bad: "The corners do not fit the model.",
    remedy: ({ fact }: About) =>
      `The residuals repeat with the distance from the image centre, so the lens model ${fact("lens")} does not describe this lens (a fisheye or a very wide lens?). Choose another lens model: rational8 for a wide lens, kannala_brandt4 for a fisheye.`,
  },
  smallest_rms_px: {
    good: "The residuals are as large as real corners make them.",
    bad: "The corners fit better than corners of real images can: they were computed or copied.",
    remedy: "Use images of the camera.",
  },
  worst_view_ratio: {
    good: "No view fits much worse than the others.",
    bad: ({ views }: About) => `Fits much worse than the other views: ${views}.`,
    remedy: ({ views }: About) => `Look at the corners of ${views} and take it again.`,
  },
  outlier_share: {
    good: "Hardly any corner lies off.",
    bad: "Too many corners lie more than four sigma off.",
    remedy: "Look for reflections, dirt or something in front of the board.",
  },
  board_bend: {
    good: ({ share }: About) =>
      `Out-of-plane shape of the board that fits best, peak to peak; it explains ${share("share")} of the squared residuals.`,
  },
  focal_sd_share: {
    good: "The focal length is well determined.",
    bad: "The focal length is too uncertain.",
    remedy: "Add views with the board tilted to both sides and close to the camera.",
  },
  centre_sd_px: {
    good: "The principal point is well determined.",
    bad: "The principal point is too uncertain.",
    remedy:
      "Add views with the board tilted to both sides and close to the camera, and with the board turned by about 90 degrees.",
  },
  zone_mapping_px: {
    good: "The expected mapping error over the working zone is small.",
    bad: "Points in the working zone would be mapped too inaccurately.",
    remedy: "Add views, above all where the working zone was hardly covered.",
  },
  valid_mapping_px: {
    good: "The expected mapping error is small everywhere in the valid region.",
    bad: "At the border of the valid region the mapping is too uncertain.",
    remedy: "Add views with the board in the corners of the image.",
  },
  converged: {
    good: "The solver proved that it reached the optimum.",
    bad: "The solver did not reach one optimum from every start.",
    remedy:
      "The views do not determine this camera, or the lens model does not suit it: take other views, with the board tilted, fix the coefficients that this lens does not need, or choose another lens model.",
  },
  agreement_px: {
    good: "All starts of the solver lead to the same camera.",
    bad: "Different starts of the solver lead to different cameras.",
    remedy:
      "The views do not determine this camera, or the lens model does not suit it: take other views, with the board tilted, fix the coefficients that this lens does not need, or choose another lens model.",
  },
  monotone_ratio: {
    good: "The distortion grows steadily beyond the farthest corner.",
    bad: "The distortion folds back inside the image, so that two directions share a pixel.",
    remedy:
      "The lens is wider than this lens model can describe, or no corner was seen near the border: add views with the board in the corners of the image. Choose another lens model: rational8 for a wide lens, kannala_brandt4 for a fisheye.",
  },
  square_pixels: {
    good: "fx and fy are in the ratio that the pixels give them.",
    bad: "The ratio of fx to fy is off: image or squares were stretched.",
    remedy: "Measure the board, and record without scaling.",
  },
  bias_ratio: {
    good: "The residuals are as small as the noise of the corners alone.",
    bad: "Part of the residuals is no noise: the model leaves something behind.",
    remedy:
      "Check that the board is flat and rigid and that the lens model suits the lens; a certified board on a plate of glass or aluminium shows which of the two it is.",
  },
  neighbour_correlation: {
    good: "The residuals of neighbouring corners have nothing in common.",
    bad: "Neighbouring corners are off in the same direction, so it is no noise.",
    remedy:
      "Check that the board is flat and rigid and that the lens model suits the lens; a certified board on a plate of glass or aluminium shows which of the two it is.",
  },
  half_difference: {
    good: "Halves of the views lead to the same camera, as far as noise lets them.",
    bad: "Halves of the views lead to different cameras.",
    remedy:
      "Check that all images are of this one camera, that its lens is fixed and focused, and that the serial is that of the camera; then take the views again.",
  },
  held_out_ratio: {
    good: "Every view fits the camera that the others find.",
    bad: ({ views }: About) => `This view fits the camera that the others find least of all: ${views}.`,
    remedy: ({ views }: About) =>
      `Take it again, or add views of that kind: ${views} alone decides too much.`,
  },
  focal_off_share: {
    good: "The focal length is that of the SKU.",
    bad: "The focal length is not that of the SKU.",
    remedy: "Check that the camera is of this SKU, its images are not scaled, and the nominal is right.",
  },
  centre_off_px: {
    good: "The principal point is where the SKU has it.",
    bad: "The principal point is not where the SKU has it.",
    remedy: "Check that the lens is not decentred, the images are not cropped, and the nominal is right.",
  },
  other_sku: {
    good: "No other SKU is nearer to this camera.",
    bad: ({ fact }: About) => `This camera looks like one of SKU ${fact("sku")}.`,
    remedy: "Check which camera is built in, and open the run for its SKU.",
  },
  population_units: {
    good: ({ fact }: About) =>
      `${fact("count")} of ${fact("of")} cameras of this SKU revision are known; until all are, its start limits hold.`,
  },
  population_distance: {
    good: ({ fact }: About) => `This camera is like the ${fact("units")} others of its SKU.`,
    bad: ({ fact }: About) =>
      `This camera is unlike the ${fact("units")} others of its SKU: ${fact("parameter")} is ${fact("deviations")} standard deviations off, more than any other parameter.`,
    remedy:
      "Check that the camera is of this SKU and its lens sits right. If its parts have changed, add a revision of the SKU: its population starts anew.",
  },
  other_population: {
    good: "The declared SKU explains this camera best.",
    bad: ({ fact }: About) => `This camera is far likelier to be one of SKU ${fact("sku")}.`,
    remedy: "Check which camera is built in, and open the run for its SKU.",
  },
  other_population_twin: {
    good: ({ fact }: About) =>
      `Cameras of SKU ${fact("sku")} are so much like these that no picture tells them apart.`,
    bad: ({ fact }: About) => `This camera is far likelier to be one of SKU ${fact("sku")}.`,
    remedy: "Check which camera is built in, and open the run for its SKU.",
  },
  used_elsewhere: {
    good: "No picture was used for another serial.",
    bad: ({ views }: About) => `Already used for another serial: ${views}.`,
    remedy: "Check which camera the station read, and take the pictures of this vehicle's camera.",
  },
  translation_sd_mm: {
    good: "The camera's position in the vehicle is well determined.",
    bad: "The camera's position in the vehicle is uncertain.",
    remedy:
      "Use a larger fixed target, or one nearer to the camera and tilted against it, and measure its place again.",
  },
  rotation_sd_mdeg: {
    good: "The camera's direction in the vehicle is well determined.",
    bad: "The camera's direction in the vehicle is uncertain.",
    remedy:
      "Use a larger fixed target, or one nearer to the camera and tilted against it, and measure its place again.",
  },
  mounting_off_mm: {
    good: "The camera is where it belongs.",
    bad: "The camera is not where it belongs.",
    remedy: "Check how the camera is mounted, and that the station's fixture is the one that stands there.",
  },
  mounting_off_mdeg: {
    good: "The camera looks where it should.",
    bad: "The camera does not look where it should.",
    remedy: "Check how the camera is mounted, and that the station's fixture is the one that stands there.",
  },
  extrinsics_rms_px: {
    good: "The corners of the fixed target fit its pose.",
    bad: "The corners of the fixed target do not fit its pose.",
    remedy: "Check that the fixed target is the declared one and flat, and that nothing covers it.",
  },
  image_agreement_px: {
    good: "All pictures of the fixed target show it in the same place.",
    bad: "The camera or the fixed target moved between the pictures.",
    remedy: "Let the vehicle stand still, then take the pictures of the fixed target again.",
  },
  tilt_ambiguity: {
    good: "Only one tilt of the fixed target explains its corners.",
    bad: "Two tilts of the fixed target explain its corners almost equally.",
    remedy: "Use a larger fixed target, or one nearer to the camera and tilted against it.",
  },
  paper_score: { good: "The paper’s score against the SKU’s nominal camera; higher is nearer." },
  nominal_difference_px: { good: "How far this camera maps the working zone from the SKU’s nominal camera." },
} satisfies Record<string, Advice>;
