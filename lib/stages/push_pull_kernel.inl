// Included once per instruction set, inside its namespace, behind four_lanes.inl. Push and pull.
// Floor 7 (stages).

// Of some bands next to each other, in the trees of one surface after the other.
template <int Lanes, class Places>
class TreeSweep {
 public:
  TreeSweep(const PushPullRoots& all, Places places, int first_band)
      : nodes_(*all.nodes),
        places_(places),
        bands_(static_cast<size_t>(all.bands)),
        emission_of_patch_(all.emission + first_band),
        reflectance_of_patch_(all.reflectance + first_band),
        irradiance_(all.irradiance + first_band),
        radiosity_(all.radiosity + first_band) {}

  // The leaves' irradiance times exposed share, as the mean over the root's area.
  void sweep(NodeId root, int32_t patch, FourDoubles& sum) {
    const size_t of_patch = static_cast<size_t>(patch) * bands_;
    take_some<Lanes>(emission_of_patch_ + of_patch, emission_);
    take_some<Lanes>(reflectance_of_patch_ + of_patch, reflectance_);
    const NodeId cluster = nodes_[root].parent;
    FourDoubles from_above = {};
    if (cluster >= 0) widen_some<Lanes>(irradiance_ + places_[cluster] * bands_, from_above);
    double weight = 0;
    go(root, places_[root] * bands_, from_above, sum, weight);
  }

 private:
  // at: of its values. Adds irradiance times exposed share, and that share, as means over the
  // node's area, to `sum` and `weight`.
  void go(NodeId id, size_t at, const FourDoubles& from_above, FourDoubles& sum, double& weight) {
    const NodeId first = nodes_.first_child(id);
    if (first < 0)
      at_leaf(id, at, from_above, sum, weight);
    else
      below(at, first, from_above, sum, weight);
  }
  void at_leaf(NodeId id, size_t at, const FourDoubles& from_above, FourDoubles& sum,
               double& weight) {
    FourDoubles down;
    widen_some<Lanes>(irradiance_ + at, down);
    down += from_above;
    const double exposed = nodes_.exposed(id);
    const FourDoubles nothing = {};
    write(at, exposed > 0 ? down : nothing, down);
    sum += exposed * down;
    weight += exposed;
  }
  void below(size_t at, NodeId first, const FourDoubles& from_above, FourDoubles& sum,
             double& weight) {
    FourDoubles down;
    widen_some<Lanes>(irradiance_ + at, down);
    down += from_above;
    FourDoubles pulled = {};
    double exposed = 0;
    size_t at_child = places_[first] * bands_;  // brothers' stand side by side
    for (NodeId child = first; child < first + 4; ++child, at_child += bands_)
      go(child, at_child, down, pulled, exposed);
    sum += pulled / 4.0;
    const FourDoubles nothing = {};
    write(at, exposed > 0 ? pulled / exposed : nothing, pulled);
    weight += exposed / 4;
  }

  // kept: in single precision, of which parents have the means.
  void write(size_t at, FourDoubles irradiance, FourDoubles& kept) {
    FourFloats single;
    narrow(irradiance, single);
    std::memcpy(irradiance_ + at, &single, Lanes * sizeof(float));
    widen(single, kept);
    narrow(emission_ + reflectance_ * irradiance, single);
    std::memcpy(radiosity_ + at, &single, Lanes * sizeof(float));
  }

  const NodeArray& nodes_;
  const Places places_;
  const size_t bands_;
  const double *const emission_of_patch_, *const reflectance_of_patch_;
  float *const irradiance_, *const radiosity_;
  FourDoubles emission_, reflectance_;
};

template <int Lanes, class Places>
inline void push_pull_some(const PushPullRoots& all, Places places, int first_band, double* sums) {
  TreeSweep<Lanes, Places> sweep(all, places, first_band);
  for (size_t k = 0; k < all.count; ++k) {
    FourDoubles sum = {};
    sweep.sweep(all.roots[k], all.surfaces[all.roots[k]].patch, sum);
    std::memcpy(sums + k * static_cast<size_t>(all.bands) + first_band, &sum,
                Lanes * sizeof(double));
  }
}

// Four bands at a time.
template <class Places>
inline void push_pull_at(const PushPullRoots& all, Places places, double* sums) {
  int band = 0;
  for (; all.bands - band >= 4; band += 4) push_pull_some<4>(all, places, band, sums);
  switch (all.bands - band) {
    case 3: return push_pull_some<3>(all, places, band, sums);
    case 2: return push_pull_some<2>(all, places, band, sums);
    case 1: return push_pull_some<1>(all, places, band, sums);
    default: return;
  }
}

inline void push_pull(const PushPullRoots& all, double* sums) {
  if (all.places->of_all())
    push_pull_at(all, LightPlaces::OfAll(), sums);
  else
    push_pull_at(all, LightPlaces::OfSome(*all.places), sums);
}
