// Texts in English of what helps an operator on: another pose first, light, and the board that is moved by hand.
export const enHelp = {
  help_another_first: "Another pose first; the one before comes back later",
  help_added_accuracy: "One more pose, to make the result accurate",
  help_added_weak: "One more pose, in place of a picture that was not good enough",
  help_added_reach: "Another pose, in place of the one that is out of reach",
  help_pose_added: (number: number) => `Extra pose ${number}`,
  help_board_away: "No board in the picture. Hold the board before the camera to go on",
  help_more_light: "It is too dark for the camera: switch a lamp on, or take away what stands in the light",
  help_less_light: "Light shines back from the board: shade the lamp or the window, or dim it",
  help_override: "Take it anyway",

  hand_area: "Virtual board: drag to move it",
  hand_shift: "Move",
  hand_tilt: "Tilt",
  hand_roll: "Rotate",
  hand_help:
    "Drag: move. Wheel: closer or away. Right button or Shift: tilt. Q, E or Alt: rotate. Two fingers: all but tilt.",
};
