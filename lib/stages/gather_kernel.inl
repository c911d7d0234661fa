// Included once per instruction set, inside its namespace, behind four_lanes.inl. Gathering.
// Floor 7 (stages).

// Sources lie all over the memory: they are asked for so many links before they are needed.
constexpr uint32_t links_ahead = 48;

template <int Bands, bool Ahead, class Places>
inline void add_run(const Link* link, const Link* last, Places places, const float* sources,
                    FourDoubles& sum) {
  for (; link != last; ++link) {
    if (Ahead) __builtin_prefetch(sources + places[link[links_ahead].source] * Bands);
    FourDoubles source;
    widen(sources + places[link->source] * Bands, source);
    const double weight = link->weight;
    sum += weight * source;
  }
}

template <int Bands, class Places>
inline void gather_runs_of(const LinkRuns& runs, Places places, const float* sources, float* out) {
  uint32_t first = runs.first;
  for (size_t k = 0; k < runs.count; ++k) {
    const uint32_t end = runs.ends[k];
    FourDoubles sum = {};
    if (runs.all - end >= links_ahead)
      add_run<Bands, true>(runs.links + first, runs.links + end, places, sources, sum);
    else
      add_run<Bands, false>(runs.links + first, runs.links + end, places, sources, sum);
    first = end;
    float* const to = out + places[runs.first_receiver + runs.receivers[k]] * Bands;
    for (int b = 0; b < Bands; ++b) to[b] += static_cast<float>(sum[b]);
  }
}

template <class Places>
inline void gather_runs_at(const LinkRuns& runs, Places places, const float* sources, int bands,
                           float* out) {
  if (bands == 2) return gather_runs_of<2>(runs, places, sources, out);
  if (bands == 3) return gather_runs_of<3>(runs, places, sources, out);
  gather_runs_of<4>(runs, places, sources, out);
}

inline void gather_runs(const LinkRuns& runs, const LightPlaces& places, const float* sources,
                        int bands, float* out) {
  if (places.of_all())
    gather_runs_at(runs, LightPlaces::OfAll(), sources, bands, out);
  else
    gather_runs_at(runs, LightPlaces::OfSome(places), sources, bands, out);
}
