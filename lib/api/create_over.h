// How the library hrad_mpi makes a solver over a communicator; no part of the public interface.
// Floor 9 (api).
#pragma once

#include "hrad/hrad.h"
#include "machine/comm.h"

// Makes an empty solver that owns comm, also when this fails. [C]
extern "C" HRAD_API hrad_status hrad_create_over(hrad::Comm* comm, hrad_solver** solver);

// The same over what make(host) makes. What that throws becomes the status and message of this
// call.
using hrad_comm_maker = hrad::Comm* (*)(const void* host);
extern "C" HRAD_API hrad_status hrad_create_over_made(hrad_comm_maker make, const void* host,
                                                      hrad_solver** solver);
