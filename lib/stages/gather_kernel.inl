// Included once per instruction set, inside its namespace, behind four_lanes.inl. Gathering.
// Floor 7 (stages).

// Sources lie all over the memory: they are asked for so many links before they are needed.
constexpr uint32_t links_ahead = 48;

template <int Bands, bool Ahead>
inline void add_run(const Link* link, const Link* last, const float* sources, FourDoubles& sum) {
  for (; link != last; ++link) {
    if (Ahead)
      __builtin_prefetch(sources + static_cast<size_t>(link[links_ahead].source) * Bands);
    FourDoubles source;
    widen(sources + static_cast<size_t>(link->source) * Bands, source);
    const double weight = link->weight;
    sum += weight * source;
  }
}

template <int Bands>
inline void gather_runs_of(const LinkRuns& runs, const float* sources, float* out) {
  const Link* const links = runs.links.data();
  const size_t count = runs.links.size();
  for (const GatherRun& run : runs.runs) {
    FourDoubles sum = {};
    if (count - run.end >= links_ahead)
      add_run<Bands, true>(links + run.first, links + run.end, sources, sum);
    else
      add_run<Bands, false>(links + run.first, links + run.end, sources, sum);
    float* const to = out + static_cast<size_t>(run.receiver) * Bands;
    for (int b = 0; b < Bands; ++b) to[b] += static_cast<float>(sum[b]);
  }
}

inline void gather_runs(const LinkRuns& runs, const float* sources, int bands, float* out) {
  if (bands == 2) return gather_runs_of<2>(runs, sources, out);
  if (bands == 3) return gather_runs_of<3>(runs, sources, out);
  gather_runs_of<4>(runs, sources, out);
}
