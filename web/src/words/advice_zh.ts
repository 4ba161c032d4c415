// What each reason of a gate says, in Chinese (simplified): what is good, what is wrong, what to do.
import type { About, Advice } from "./advice";
import type { adviceEn } from "./advice_en";

const QUADRANTS: Readonly<Record<string, string>> = {
  "top-left": "左上",
  "top-right": "右上",
  "bottom-left": "左下",
  "bottom-right": "右下",
};

const FLAT_BOARD =
  "检查标定板是否平整、刚硬，镜头模型是否适合该镜头；用玻璃板或铝板上的认证标定板可以分辨是哪一种原因。";
const UNDETERMINED =
  "这些视图不足以确定相机，或镜头模型不合适：请拍摄标定板倾斜的其他视图，固定该镜头不需要的系数，或选择另一种镜头模型。";

export const adviceZh: Record<keyof typeof adviceEn, Advice> = {
  wrong_target: {
    good: "没有图像显示申报以外的标定板。",
    bad: ({ views }: About) => `以下图像中是另一块标定板：${views}。`,
    remedy: "请使用申报的标定板，或申报实际使用的标定板。",
  },
  refused_images: {
    good: "每张图像都可用。",
    bad: ({ views }: About) => `未使用：${views}。`,
    remedy: "重新拍摄这些图像，或不使用它们。",
  },
  facing: {
    good: "每个视图中标定板都朝向相机。",
    bad: ({ views }: About) => `求解显示标定板背面朝向相机：${views}。`,
    remedy: "重新拍摄该图像；若图像是镜像的，请关闭相机的镜像。",
  },
  nearest_corner: {
    good: "每个视图中标定板都在相机前方。",
    bad: ({ views }: About) => `求解把标定板放到了相机后方：${views}。`,
    remedy: "重新拍摄该图像。",
  },
  parity_separation: {
    good: "每个视图中黑白方格都清楚可分。",
    bad: ({ views }: About) => `黑白方格难以区分：${views}。`,
    remedy: "让标定板光照均匀、没有反光，并确认它就是申报的标定板。",
  },
  contrast: {
    good: "每个视图的对比度都足够。",
    bad: ({ views }: About) => `黑白方格差别太小：${views}。`,
    remedy: "增加光照或延长曝光。",
  },
  saturated_share: {
    good: "几乎没有白色方格过曝。",
    bad: ({ views }: About) => `白色方格过曝，看不出光照的分布：${views}。`,
    remedy: "请调暗灯光、遮挡窗户或缩短曝光，然后重新拍摄。",
  },
  edge_width_px: {
    good: "每个视图都清晰。",
    bad: ({ views }: About) => `模糊：${views}。`,
    remedy: ({ views }: About) => `重新拍摄：${views}。拿稳标定板，缩短曝光，或拿远一些。`,
  },
  blurred_lens: {
    good: "每个视图都清晰。",
    bad: ({ fact }: About) => `${fact("of")} 个视图中有 ${fact("count")} 个模糊。`,
    remedy: "先调好镜头焦点，再重新拍摄。",
  },
  quadrant_ratio: {
    good: "各象限与中心一样清晰。",
    bad: ({ fact }: About) =>
      `图像${QUADRANTS[fact("quadrant")] ?? fact("quadrant")}比中心模糊：镜头倾斜或偏心。`,
    remedy: "检查镜头的安装和对焦。",
  },
  missing_poses: {
    good: "规定的位姿全部采集。",
    bad: ({ poses }: About) => `未采集：${poses}。`,
    remedy: "在这些位姿各拍一张图像。",
  },
  early_finish: {
    good: ({ fact }: About) =>
      `${fact("taken")} 个位姿已证明达到要求的精度；${fact("not_needed")} 个规定位姿不再需要。`,
  },
  match_px: {
    good: "每个视图都在规定的位姿上。",
    bad: ({ views }: About) => (views === "" ? "没有视图在规定的位姿上。" : `离规定的位姿太远：${views}。`),
    remedy: "重新采集，更贴近显示的位姿。",
  },
  view_separation_px: {
    good: "没有重复的视图。",
    bad: ({ views }: About) => `这些视图中标定板在同一位置，只相当于一张：${views}。`,
    remedy: "去掉其中一张，并在拍摄之间移动标定板。",
  },
  image_coverage: {
    good: "图像中见到角点的部分所占的比例；标定只在那里有效。",
  },
  coverage: {
    good: "视图覆盖了工作区。",
    bad: "工作区的一部分从未见到标定板。",
    remedy: "增加标定板靠近图像边缘的视图。",
  },
  rms_px: {
    good: "标定板、镜头模型和角点相符。",
    bad: "角点与模型不符。",
    remedy:
      "检查所有图像是否来自同一相机且未缩放，标定板是否为申报的、刚硬且平整，拍摄时是否没有任何东西移动。",
  },
  rms_no_optimum: {
    good: "标定板、镜头模型和角点相符。",
    bad: "角点与模型不符。",
    remedy: ({ fact }: About) => `请先看“模型”检查项：镜头模型 ${fact("lens")} 可能不能描述该镜头。`,
  },
  rms_bent_board: {
    good: "标定板、镜头模型和角点相符。",
    bad: "角点与模型不符。",
    remedy: ({ share }: About) =>
      `残差随标定板的角点重复，标定板很可能不平（弯曲约为方格的 ${share("bend")}）。请把图案装在刚硬平整的板上。`,
  },
  rms_other_lens: {
    good: "标定板、镜头模型和角点相符。",
    bad: "角点与模型不符。",
    remedy: ({ fact }: About) =>
      `残差随到图像中心的距离重复，说明镜头模型 ${fact("lens")} 不能描述该镜头（鱼眼或超广角？）。请选择另一种镜头模型：广角用 rational8，鱼眼用 kannala_brandt4。`,
  },
  smallest_rms_px: {
    good: "残差与真实角点应有的一样大。",
    bad: "角点吻合得比真实图像可能的还好：它们是算出来的或复制的。",
    remedy: "请使用该相机拍摄的图像。",
  },
  worst_view_ratio: {
    good: "没有视图明显差于其他视图。",
    bad: ({ views }: About) => `明显差于其他视图：${views}。`,
    remedy: ({ views }: About) => `查看 ${views} 的角点并重新拍摄。`,
  },
  outlier_share: {
    good: "几乎没有偏离的角点。",
    bad: "偏离超过四倍 σ 的角点太多。",
    remedy: "检查有无反光、污物或标定板前的遮挡。",
  },
  board_bend: {
    good: ({ share }: About) =>
      `与数据最吻合的标定板离面形状，峰峰值；它解释了残差平方和的 ${share("share")}。`,
  },
  focal_sd_share: {
    good: "焦距确定得很好。",
    bad: "焦距太不确定。",
    remedy: "增加标定板向两侧倾斜、靠近相机的视图。",
  },
  centre_sd_px: {
    good: "主点确定得很好。",
    bad: "主点太不确定。",
    remedy: "增加标定板向两侧倾斜、靠近相机的视图，以及标定板转约 90 度的视图。",
  },
  zone_mapping_px: {
    good: "工作区内预期的映射误差很小。",
    bad: "工作区内的点映射得不够准确。",
    remedy: "增加视图，尤其是在工作区中覆盖不足的地方。",
  },
  valid_mapping_px: {
    good: "有效区内各处预期的映射误差都很小。",
    bad: "有效区边缘的映射太不确定。",
    remedy: "增加标定板在图像角落的视图。",
  },
  converged: {
    good: "求解器证明已达到最优。",
    bad: "求解器从不同起点没有达到同一个最优。",
    remedy: UNDETERMINED,
  },
  agreement_px: {
    good: "求解器的所有起点都得到同一台相机。",
    bad: "求解器的不同起点得到不同的相机。",
    remedy: UNDETERMINED,
  },
  monotone_ratio: {
    good: "畸变在最远角点之外仍稳定增长。",
    bad: "畸变在图像内折回，两个方向落在同一像素。",
    remedy:
      "镜头比该镜头模型所能描述的更广，或边缘附近没有角点：请增加标定板在图像角落的视图。或选择另一种镜头模型：广角用 rational8，鱼眼用 kannala_brandt4。",
  },
  square_pixels: {
    good: "fx 与 fy 的比例与像素相符。",
    bad: "fx 与 fy 的比例不对：图像或方格被拉伸。",
    remedy: "测量标定板，并且录制时不要缩放。",
  },
  bias_ratio: {
    good: "残差与角点自身的噪声一样小。",
    bad: "部分残差不是噪声：模型没有完全描述数据。",
    remedy: FLAT_BOARD,
  },
  neighbour_correlation: {
    good: "相邻角点的残差没有共同之处。",
    bad: "相邻角点朝同一方向偏离，因此不是噪声。",
    remedy: FLAT_BOARD,
  },
  half_difference: {
    good: "两半视图得到同一台相机，差别只在噪声之内。",
    bad: "两半视图得到不同的相机。",
    remedy: "检查所有图像是否来自这一台相机，镜头是否固定并对好焦，序列号是否属于该相机；然后重新拍摄。",
  },
  held_out_ratio: {
    good: "每个视图都与其余视图求得的相机相符。",
    bad: ({ views }: About) => `与其余视图求得的相机最不相符：${views}。`,
    remedy: ({ views }: About) => `重新拍摄，或增加同类视图：${views} 单独决定了太多。`,
  },
  focal_off_share: {
    good: "焦距与 SKU 相符。",
    bad: "焦距与 SKU 不符。",
    remedy: "检查相机是否属于该 SKU，图像是否未缩放，标称值是否正确。",
  },
  centre_off_px: {
    good: "主点与 SKU 相符。",
    bad: "主点与 SKU 不符。",
    remedy: "检查镜头是否未偏心，图像是否未裁剪，标称值是否正确。",
  },
  other_sku: {
    good: "没有其他 SKU 更接近该相机。",
    bad: ({ fact }: About) => `该相机看起来属于 SKU ${fact("sku")}。`,
    remedy: "检查装的是哪种相机，并按其 SKU 开始标定。",
  },
  population_units: {
    good: ({ fact }: About) =>
      `此 SKU 版本已知 ${fact("count")} 台相机（需要 ${fact("of")} 台）；在此之前仅适用初始限值。`,
  },
  population_distance: {
    good: ({ fact }: About) => `此相机与同 SKU 的 ${fact("units")} 台相机一致。`,
    bad: ({ fact }: About) =>
      `此相机与同 SKU 的 ${fact("units")} 台相机不一致：${fact("parameter")} 偏离 ${fact("deviations")} 个标准差，偏离最大。`,
    remedy: "请检查相机是否属于此 SKU、镜头是否装正。若零件已更改，请新建 SKU 版本，其总体将重新统计。",
  },
  other_population: {
    good: "所声明的 SKU 最符合此相机。",
    bad: ({ fact }: About) => `此相机更可能属于 SKU ${fact("sku")}。`,
    remedy: "请检查实际安装的相机，并为其 SKU 打开运行。",
  },
  other_population_twin: {
    good: ({ fact }: About) => `SKU ${fact("sku")} 的相机与这些相机极为相似，任何图像都无法区分。`,
    bad: ({ fact }: About) => `此相机更可能属于 SKU ${fact("sku")}。`,
    remedy: "请检查实际安装的相机，并为其 SKU 打开运行。",
  },
  used_elsewhere: {
    good: "没有图像曾用于其他序列号。",
    bad: ({ views }: About) => `已用于其他序列号：${views}。`,
    remedy: "检查工位读取的是哪台相机，并拍摄这辆车的相机的图像。",
  },
  translation_sd_mm: {
    good: "相机在车辆中的位置已充分确定。",
    bad: "相机在车辆中的位置不确定。",
    remedy: "使用更大的固定标定板，或让它更靠近相机并相对相机倾斜，然后重新测量其位置。",
  },
  rotation_sd_mdeg: {
    good: "相机在车辆中的朝向已充分确定。",
    bad: "相机在车辆中的朝向不确定。",
    remedy: "使用更大的固定标定板，或让它更靠近相机并相对相机倾斜，然后重新测量其位置。",
  },
  mounting_off_mm: {
    good: "相机位于应在的位置。",
    bad: "相机不在应在的位置。",
    remedy: "检查相机的安装，并检查工位的固定标定板是否就是所登记的那块。",
  },
  mounting_off_mdeg: {
    good: "相机朝向正确。",
    bad: "相机朝向不正确。",
    remedy: "检查相机的安装，并检查工位的固定标定板是否就是所登记的那块。",
  },
  extrinsics_rms_px: {
    good: "固定标定板的角点与其位姿相符。",
    bad: "固定标定板的角点与其位姿不符。",
    remedy: "检查固定标定板是否为所申报的、是否平整、是否被遮挡。",
  },
  image_agreement_px: {
    good: "所有图像中的固定标定板都在同一位置。",
    bad: "在拍摄之间相机或固定标定板移动过。",
    remedy: "让车辆静止，然后重新拍摄固定标定板。",
  },
  tilt_ambiguity: {
    good: "只有一种倾斜能解释固定标定板的角点。",
    bad: "两种倾斜几乎同样能解释固定标定板的角点。",
    remedy: "使用更大的固定标定板，或让它更靠近相机并相对相机倾斜。",
  },
  paper_score: { good: "论文的评分，以 SKU 的标称相机为准；越高越接近。" },
  nominal_difference_px: { good: "该相机在工作区内的映射与 SKU 标称相机相差多少。" },
};
