#!/bin/bash
# Renders one of 16 slices of the samples in each task, to a raw film. Names are meant from the folder where
# this is submitted. A task that begins again goes on from its raw film.
#SBATCH --job-name=cornell-box
#SBATCH --array=1-16
#SBATCH --output=cornell-box.slurm/slice-%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --signal=B:TERM@60
#SBATCH --time=0:30:00
# By exec it is duet that Slurm's signals reach: it writes the raw film and ends.
exec duet render scenes/cornell-box/scene.xml \
  --spp 1024 \
  --checkpoint 60s \
  --slice "$SLURM_ARRAY_TASK_ID"/16 \
  --raw cornell-box.slurm/1024spp-slice-"$SLURM_ARRAY_TASK_ID"-of-16.exr \
  --threads "$SLURM_CPUS_ON_NODE"
