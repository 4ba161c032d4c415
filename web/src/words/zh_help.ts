// Texts in Chinese (simplified) of what helps an operator on.
import type { enHelp } from "./en_help";

export const zhHelp: typeof enHelp = {
  help_another_first: "先做另一个姿态；前一个稍后再来",
  help_added_accuracy: "再加一个位姿，让结果足够精确",
  help_added_weak: "再加一个位姿，代替一张不够好的图像",
  help_added_reach: "换一个位姿，代替够不到的那个",
  help_pose_added: (number) => `附加位姿 ${number}`,
  help_board_away: "画面中没有标定板。把标定板举到相机前继续",
  help_more_light: "对相机来说太暗：打开灯，或移开挡光的东西",
  help_less_light: "标定板反光：遮挡或调暗灯光、窗户",
  help_override: "仍然拍摄",

  hand_area: "虚拟标定板：拖动即可移动",
  hand_shift: "移动",
  hand_tilt: "倾斜",
  hand_roll: "旋转",
  hand_help: "拖动：移动。滚轮：远近。右键或 Shift：倾斜。Q、E 或 Alt：旋转。双指：除倾斜外全部。",
};
