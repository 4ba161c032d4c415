// Every text in Chinese (simplified) around the runs of a kiosk: practice, the screen while nobody is there, voice,
// full screen, and the language of a station.
import type { enPractice } from "./en_practice";

export const zhPractice: typeof enPractice = {
  practice_open: "练习",
  practice_title: "练习",
  practice_detail:
    "计时标定一次并计分。不计入任何车辆，也不计入合格率。个人最佳只保存在此浏览器中，只有本人的工牌才会显示。",
  practice_badge: "工牌",
  practice_badge_hint: "扫描工牌，或留空：留空则不保存最佳成绩。",
  practice_start: "开始练习",
  practice_leave: "返回",
  practice_word: "练习",
  practice_points: "得分",
  practice_streak: "连续达标",
  practice_time: "当前位姿",
  practice_par: (seconds) => `标准 ${seconds} 秒`,
  practice_over: "超时",
  practice_under: "在标准内",
  practice_best: "个人最佳",
  practice_best_none: "还没有",
  practice_seconds: (seconds) => `${seconds} 秒`,
  practice_done: "练习结束",
  practice_of: (points, most) => `${points} 分，满分 ${most} 分`,
  practice_new_best: "新的个人最佳！",
  practice_not_whole: "页面中途重新加载过，本次不计为最佳。",
  practice_not_passed: "这些图像不会合格，本次不计为最佳。",
  practice_total: "用时",
  practice_total_of: (took, par) => `${took} 秒，标准 ${par} 秒`,
  practice_under_par: "达标位姿",
  practice_under_par_of: (count, all) => `${count} / ${all}`,
  practice_longest: "最长连续",
  practice_verdict: "这些图像会判为",
  practice_again: "再来一次",
  practice_end: "完成",

  idle_title: "等待下一辆车",
  idle_detail: "请扫描标签。按任意键或触摸屏幕即可唤醒。",

  act_speech: "语音",
  act_full_screen: "全屏",

  station_language: "终端语言",
  station_language_of: (code) => `${code} 的终端语言`,
  station_language_none: "随浏览器",
};
