// hrad_mpi.h. Floor 9 (api).
#include "api/create_over.h"
#include "hrad/hrad_mpi.h"
#include "machine/comm_mpi.h"

hrad_status hrad_create_mpi(MPI_Comm comm, hrad_solver** solver) {
  const auto make = [](const void* host) -> hrad::Comm* {
    return new hrad::CommMpi(*static_cast<const MPI_Comm*>(host));
  };
  return hrad_create_over(make, &comm, solver);
}

hrad_status hrad_create_mpi_f(MPI_Fint comm, hrad_solver** solver) {
  const auto make = [](const void* host) -> hrad::Comm* {
    hrad::require_mpi();  // the conversion needs it too
    return new hrad::CommMpi(MPI_Comm_f2c(*static_cast<const MPI_Fint*>(host)));
  };
  return hrad_create_over(make, &comm, solver);
}
