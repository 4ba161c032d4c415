// The picture of a pose set; a click into an outline picks its pose. The table of poses does the same by keyboard.
import { type JSX } from "preact";
import { useCallback, useRef } from "preact/hooks";
import { Drawing, type Draw } from "../drawing/drawing";
import { drawPoseSet } from "../drawing/pose_set_drawing";
import { outlineAt, type Outline } from "../drawing/pose_outlines";
import type { Zone } from "../drawing/heat_grid";
import { fit, toImage } from "../drawing/viewport";
import { words } from "../words/language";

interface Props {
  outlines: readonly Outline[];
  /** Index of the pose that is looked at. */
  chosen: number;
  imageSize: readonly [number, number];
  onChoose: (index: number) => void;
  /** Index of the pose under the pointer, here or in another picture of the set. */
  hovered?: number | null;
  onHover?: (index: number | null) => void;
  workingZone?: Zone;
}

export function PoseSetPicture(props: Props): JSX.Element {
  const { outlines, chosen, imageSize, onChoose, hovered = null, onHover, workingZone } = props;
  const say = words.value;
  const place = useRef<HTMLDivElement>(null);
  const [width, height] = imageSize;
  const draw = useCallback<Draw>(
    (context, size, colours) =>
      drawPoseSet(
        context,
        size,
        { outlines, chosen, hovered, imageSize: { width, height }, workingZone },
        colours,
      ),
    [outlines, chosen, hovered, width, height, workingZone],
  );
  const under = (event: MouseEvent): number | null => {
    const box = place.current?.getBoundingClientRect();
    if (box === undefined) return null;
    const at = { x: event.clientX - box.left, y: event.clientY - box.top };
    return outlineAt(outlines, toImage(fit({ width, height }, box), at));
  };
  const pick = (event: MouseEvent): void => {
    const found = under(event);
    if (found !== null) onChoose(found);
  };
  return (
    <figure class="field-figure">
      <figcaption>
        <span class="key key-point">{say.pose_key_outline}</span>
        <span class="key key-chosen">{say.pose_key_chosen(chosen + 1)}</span>
        <span class="key muted">{say.pose_key_path}</span>
        {workingZone !== undefined && <span class="key key-ring">{say.review_key_zone}</span>}
      </figcaption>
      <div
        ref={place}
        class="field pose-field"
        style={{ aspectRatio: `${width} / ${height}` }}
        onClick={pick}
        onMouseMove={onHover && ((event) => onHover(under(event)))}
        onMouseLeave={onHover && (() => onHover(null))}
      >
        <Drawing draw={draw} label={say.pose_set_label(outlines.length, chosen + 1)} />
      </div>
    </figure>
  );
}
