// Sweeping (paper, Section 2; push-pull in Hanrahan, Saltzman, Aupperle 1991): irradiance is pushed
// down to the leaves, their radiosity B = E + rho H pulled up again. Floor 7 (stages).
#pragma once

#include "stages/exchange.h"
#include "stages/gather.h"
#include "stages/light_of_all.h"
#include "stages/own_runs.h"
#include "stages/state.h"

namespace hrad {

// One iteration: gathering over own links, sweeping on own surfaces, and their radiosity sent to
// whoever has asked for it: what others send the next iteration takes, or
// Exchange::finish_update() after the last one. Returns what push_pull() does.
std::vector<double> sweep(State& state, ThreadTeam& team, Exchange& exchange, const OwnRuns& runs);

// From what gather() left in state.irradiance makes that and state.radiosity of every node. Means
// are over the exposed part; a node sealed all over has B = E and H = 0. Returns the radiosity
// transported: irradiance times exposed area over all leaves, per band, W, added up exactly.
std::vector<double> push_pull(State& state, ThreadTeam& team, Exchange& exchange);

// New elements know better than their parents what is sealed: these take the mean of their
// children.
void pull_exposure(State& state, ThreadTeam& team);

// B = E, H = 0 everywhere, with room for the light of all nodes: where every solve starts.
void reset_to_emission(State& state, ThreadTeam& team, const Exchange& exchange);

// Units and brightness from the present radiosity, without its spread of the nodes whose light a
// process keeps, and with it of all.
Brightness brightness_of_known(const State& state, ThreadTeam& team, const Exchange& exchange);
Brightness measure_brightness(const State& state, const LightOfAll& radiosity, ThreadTeam& team,
                              const Exchange& exchange);

// Before there is any irradiance: emitters by emission, the rest by the scene's mean
// interreflection.
Brightness expected_brightness(State& state);

}  // namespace hrad
