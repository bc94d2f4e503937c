#!/bin/bash
# Submits the tasks, and the merge that waits for their ends, whatever came of them.
job=$(sbatch --parsable cornell-box.slurm/render.sh) &&
  sbatch --dependency=afterany:"${job%%;*}" cornell-box.slurm/merge.sh
