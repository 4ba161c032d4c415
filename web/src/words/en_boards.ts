// Every text in English about a station's boards with their shapes, its fixture and what that tells later.
export const enBoards = {
  station_board: "Board",
  station_board_none: "none named",
  station_board_flat: "taken for flat",
  station_board_certified: (version: number, when: string, runs: number) =>
    `shape ${version}, certified ${when}, from ${runs} runs`,
  station_board_open: "Shape",
  station_board_open_of: (board: string) => `Shape of the board ${board}`,

  board_title: (board: string) => `Board ${board}`,
  board_all: "All boards",
  board_in_use: (version: number, when: string) =>
    `Solves at this board’s stations use its shape ${version}, certified ${when}.`,
  board_flat:
    "Solves take this board for flat. No plate is: certify a learnt shape, and runs from then on are solved with it.",
  board_steady: (moved: string, limit: string) =>
    `The newest shape is ${moved} mm from the certified one; ${limit} mm are allowed.`,

  shapes_title: "Shapes",
  shapes_note: "newest first; choose one to see it",
  shapes_none: "No shape has been learnt yet.",
  shapes_caption: "The shapes of this board, newest first",
  shape_version: (version: number) => `Shape ${version}`,
  shape_col_version: "Shape",
  shape_col_state: "State",
  shape_col_learnt: "Learnt",
  shape_col_runs: "Runs",
  shape_col_bend: "Bend",
  shape_col_certainty: "Corners ±",
  shape_col_drift: "Moved",
  shape_draft: "learnt",
  shape_certified: "certified",
  shape_retired: "retired",
  shape_since: (when: string, who: string) => `since ${when}, by ${who}`,
  shape_drift_steady: "steady",
  shape_drift_near: "near the limit",
  shape_drift_over: "over the limit",

  shape_heights: "Height over the board",
  shape_heights_note: "towards the camera, above the lowest corner",
  shape_corner: (corner: number, height: string, sd: string) => `corner ${corner}: ${height} ± ${sd} µm`,
  shape_bend: "Bend, peak to peak",
  shape_in_plane: "Farthest within the plane",
  shape_corner_sd: "Corners known to (1 sd)",
  shape_noise: "Noise of the corners, flat → this shape",
  shape_camera_sd: "Common to all cameras (1 sd)",
  shape_camera_sd_note: "focal length / centre / map",
  shape_by: "Learnt by",
  shape_certified_fact: "Certified",
  shape_retired_fact: "Retired",

  shape_certify: "Certify",
  shape_certify_ask: "Certify this shape?",
  shape_certify_detail: (board: string) =>
    `Runs at the stations of ${board} are solved with it from now on, and the shape before it is retired. Results of before stay as they are.`,
  shape_retire: "Retire",
  shape_retire_ask: "Retire this shape?",
  shape_retire_certified: (board: string) =>
    `Runs at the stations of ${board} take the board for flat again until another shape is certified. Results of before stay as they are. A retired shape cannot come back.`,
  shape_retire_draft: "It can no longer be certified. A retired shape cannot come back.",
  shape_leave: "Leave it as it is",

  learn_title: "Learn the shape",
  learn_detail:
    "From the last finished runs at stations with this board, in the background. What is learnt is not used before it is certified; more runs know the corners better.",
  learn_runs: "From how many runs",
  learn_start: "Learn",
  learn_running: (percent: string) => `The shape is being learnt: ${percent}`,

  drift_title: "Drift",
  drift_note: "farthest corner, mm, from the shape that was certified then",
  drift_key: "● steady ▲ near ◆ over · ┄ limit",
  drift_chart: (count: number) =>
    `Farthest move of a corner over ${count} learnt shapes; the table of shapes has the numbers`,
  drift_read: (version: number, when: string, moved: string, focal: string) =>
    `Shape ${version}, ${when}: ${moved} mm, focal length off by ${focal} px`,

  fixture: "Fixture",
  fixture_of: (code: string) => `Fixture of ${code}`,
  fixture_none: "none",
  fixture_place: (position: string) => `at ${position} mm`,
  fixture_set: "Set",
  fixture_hint:
    "Where a fixed target stands in the vehicle frame (T_vehicle_board) when a vehicle is at the station. It holds for pictures that are taken from now on; results keep the one they were made with.",
  fixture_target: "Pattern",
  fixture_target_hint: "such as chessboard:9x6:40mm",
  fixture_position: "Position of corner 0, mm",
  fixture_position_axis: (axis: string) => `Position ${axis}, mm`,
  fixture_rotation: "Rotation vector, °",
  fixture_rotation_axis: (axis: string) => `Rotation ${axis}, °`,
  fixture_certainty: "Known to (1 sd)",
  fixture_translation_sd: "Position ±, mm",
  fixture_rotation_sd: "Rotation ±, mdeg",
  fixture_remove: "Remove",
  fixture_remove_ask: "Remove the fixture?",
  fixture_remove_detail: (code: string) =>
    `Pictures of a fixed target are refused at ${code} from now on, and new runs there do not tell where the camera is in the vehicle. Results of before stay as they are.`,

  later_extrinsics_title: "Place in the vehicle, after the run",
  later_extrinsics_when: (when: string, station: string) => `${when} at ${station}`,
};
