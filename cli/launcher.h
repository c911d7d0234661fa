// The processes that mpirun or srun started beside this one. Commands that solve run on all of
// them: each makes the same calls of the library, the first one alone prints and writes files of
// the tool's own. What the first one finds out (files, clocks), the others take from it, so that
// all go the same way. CLI: public headers only.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "hrad/hrad.h"

namespace hrad::cli::launcher {

// As --mpi says. Commands that need one process leave the work to the first one.
enum class Choice { automatic, on, off };
enum class Work { of_all, of_the_first };

// Called once, when the options are known. Returns false where this process has nothing to do, as
// another one does the work. Failure (MPI).
bool start(Choice choice, Work work);

// Whether several processes solve together.
bool several();
// Whether this process prints: the first one does, and every one that works by itself.
bool speaks();

// The first process alone does this; a Failure of it is one of all. To be called by all.
void on_first(const std::function<void()>& work);
// To be called by all: what the first one has, or the largest of what they have.
int64_t of_first(int64_t mine);
void share_of_first(std::string* text);
int64_t largest(int64_t mine);

// A solver of this process alone, or of all.
hrad_status create(hrad_solver** solver);

// The end of the tool on all processes: takes and returns the exit code, the same on all.
int finish(int code);
// The end where only this process has failed: the others would wait for it.
int finish_alone(int code);

}  // namespace hrad::cli::launcher
