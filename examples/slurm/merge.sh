#!/bin/bash
# Adds up the raw films that the tasks have left, and names the slices that lack samples.
#SBATCH --job-name=cornell-box-merge
#SBATCH --output=cornell-box.slurm/merge.log
#SBATCH --requeue
#SBATCH --time=0:30:00
exec duet merge cornell-box.slurm/1024spp-slice-{1..16}-of-16.exr -o cornell-box.exr \
  --slices 16 --spp 1024 \
  --slice-command 'duet render scenes/cornell-box/scene.xml --spp 1024 --checkpoint 60s --slice {slice}/16 --raw cornell-box.slurm/1024spp-slice-{slice}-of-16.exr'
