// How the library hrad_mpi makes a solver over a communicator; no part of the public interface.
// Floor 9 (api).
#pragma once

#include "hrad/hrad.h"
#include "machine/comm.h"

// Makes an empty solver over the Comm that make(host) makes, which it owns, also when this fails.
// What make throws becomes the status and message of this call. [C]
using hrad_comm_maker = hrad::Comm* (*)(const void* host);
extern "C" HRAD_API hrad_status hrad_create_over(hrad_comm_maker make, const void* host,
                                                 hrad_solver** solver);
