#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#SBATCH --job-name=occusg
#SBATCH --array=1-8
#SBATCH --cpus-per-task=2
#SBATCH --mem-per-cpu=2G
#SBATCH --output=occusg-%A_%a.log
# One shard of a batch as a task of a Slurm array; docs/batch.md has the commands around it.
# OCCUSG names the binary, else the one in PATH.
# Usage: sbatch [--array=1-N] scripts/batch_slurm.sh OUT RECORDING... [options of 'occusg batch']
set -euo pipefail
if [ $# -lt 2 ]; then
  echo "usage: sbatch scripts/batch_slurm.sh OUT RECORDING... [options of 'occusg batch']" >&2
  exit 2
fi
if [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
  echo "batch_slurm.sh: SLURM_ARRAY_TASK_ID is not set; start it with sbatch --array=1-N" >&2
  exit 2
fi
out=$1
shift
first=${SLURM_ARRAY_TASK_MIN:-1}
shard=$((SLURM_ARRAY_TASK_ID - first + 1))
exec "${OCCUSG:-occusg}" batch "$@" -o "$out" --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --shard "$shard/${SLURM_ARRAY_TASK_COUNT:-1}"
