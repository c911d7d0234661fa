# shellcheck shell=bash
# Sourced: what Open MPI's mpirun needs on any machine, also by root, with more ranks than cores, where
# there is no ssh, and without being bound to one core. CMake gives its tests the same.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
  OMPI_MCA_btl=vader,self OMPI_MCA_plm=isolated OMPI_MCA_hwloc_base_binding_policy=none
