// One line for each process, one warning for each node. Floor 8 (solver).
#include "solver/team_report.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "machine/host_name.h"
#include "machine/sharing.h"

namespace hrad {
namespace {

struct Team {
  int32_t node = 0, threads = 1, sharers = 1, processors = 1;
  std::string host, reason;

  bool fights() const { return sharers > 1 && int64_t{threads} * sharers > processors; }
};

std::vector<Team> teams_of_all(Comm& comm, const Team& own) {
  Bytes bytes;
  put(bytes, &own.node, 1);
  put(bytes, &own.threads, 1);
  put(bytes, &own.sharers, 1);
  put(bytes, &own.processors, 1);
  put_list(bytes, own.host);
  put_list(bytes, own.reason);
  std::vector<Team> teams;
  for (const Bytes& of_rank : comm.gather_all(bytes)) {
    Taker taker(of_rank);
    Team& team = teams.emplace_back();
    taker.take(&team.node, 1);
    taker.take(&team.threads, 1);
    taker.take(&team.sharers, 1);
    taker.take(&team.processors, 1);
    take_list(taker, team.host);
    take_list(taker, team.reason);
  }
  return teams;
}

void warn_of_fight(const Team& team, const Log& log) {
  log.write(Log::warning,
            format("%d processes on node %s would run %lld threads on the same %d processors: "
                   "start fewer, or give each its own, as by mpirun --map-by slot:PE=%d",
                   team.sharers, team.host.c_str(),
                   static_cast<long long>(int64_t{team.threads} * team.sharers), team.processors,
                   team.threads));
}

}  // namespace

void report_teams(Comm& comm, const Topology& topology, const PoolPlan& plan, const Log& log) {
  const Team own = {comm.node(), plan.threads, plan.sharers, topology.usable_contexts,
                    host_name(), plan.reason};
  const std::vector<Team> teams = teams_of_all(comm, own);
  if (comm.rank() > 0) {
    if (own.fights()) warn_of_fight(own, log);
    return;
  }
  std::vector<int32_t> warned_of;
  for (size_t rank = 0; rank < teams.size(); ++rank) {
    const Team& team = teams[rank];
    log.write(Log::info, format("process %zu on node %s: %d thread%s (%s)", rank, team.host.c_str(),
                                team.threads, team.threads == 1 ? "" : "s", team.reason.c_str()));
    if (!team.fights() ||
        std::find(warned_of.begin(), warned_of.end(), team.node) != warned_of.end())
      continue;
    warned_of.push_back(team.node);
    warn_of_fight(team, log);
  }
}

}  // namespace hrad
