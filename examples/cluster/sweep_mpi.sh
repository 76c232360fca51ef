#!/bin/sh
# sweep_mpi.sh PROCESSES [OPTION OF mpirun]...: a sweep over processes of OpenMPI, into a folder that all machines see.
# The spec is SPEC, faces.toml if not set, the folder FOLDER, faces.sweep. Needs a tumble built with -DTUMBLE_MPI=ON.
#
#   ./sweep_mpi.sh 64 --hostfile hosts           (in a job of Slurm or PBS, mpirun knows the machines)
set -eu

processes=${1:?"how many processes? One for each core"}
shift
# Each process computes on one core. Without --bind-to none a second mpirun on a machine would be bound to the cores of the first.
exec mpirun -n "$processes" --bind-to none "$@" tumble sweep "${SPEC:-faces.toml}" -o "${FOLDER:-faces.sweep}"
