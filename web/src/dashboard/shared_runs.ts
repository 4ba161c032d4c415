// Shared pictures by the run that holds them too.
import type { SharedPicture } from "../generated/api";

export interface SharingRun {
  id: string;
  serial: string;
  /** When the first of its pictures was taken over or taken. */
  since: string;
  pictures: readonly SharedPicture[];
}

export function byRun(shared: readonly SharedPicture[]): SharingRun[] {
  const ids = [...new Set(shared.map(({ other_run_id }) => other_run_id))];
  return ids.flatMap((id) => {
    const pictures = shared.filter(({ other_run_id }) => other_run_id === id);
    const [first] = pictures;
    return first === undefined
      ? []
      : [{ id, serial: first.other_serial, since: first.other_created_at, pictures }];
  });
}
