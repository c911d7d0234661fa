// Included once per instruction set, inside its namespace, behind four_lanes.inl. Push and pull.
// Floor 7 (stages).

// Of some bands next to each other.
template <int Lanes>
class TreeSweep {
 public:
  TreeSweep(const PushPullTree& tree, int first_band)
      : nodes_(tree.nodes),
        bands_(static_cast<size_t>(tree.bands)),
        irradiance_(tree.irradiance + first_band),
        radiosity_(tree.radiosity + first_band) {
    take_some<Lanes>(tree.emission + first_band, emission_);
    take_some<Lanes>(tree.reflectance + first_band, reflectance_);
  }

  // Adds irradiance times exposed share, and that share, as means over the node's area, to `sum`
  // and `weight`.
  void go(NodeId id, const FourDoubles& from_above, FourDoubles& sum, double& weight) {
    FourDoubles down;
    widen_some<Lanes>(irradiance_ + at(id), down);
    down += from_above;
    const FourDoubles nothing = {};
    const Node& node = nodes_[id];
    if (node.first_child < 0) {
      const double exposed = node.exposed;
      write(id, exposed > 0 ? down : nothing, down);
      sum += exposed * down;
      weight += exposed;
      return;
    }
    FourDoubles below = {};
    double exposed = 0;
    for (NodeId child = node.first_child; child < node.first_child + 4; ++child)
      go(child, down, below, exposed);
    sum += below / 4.0;
    write(id, exposed > 0 ? below / exposed : nothing, below);
    weight += exposed / 4;
  }

 private:
  size_t at(NodeId id) const { return static_cast<size_t>(id) * bands_; }
  // kept: in single precision, of which parents have the means.
  void write(NodeId id, FourDoubles irradiance, FourDoubles& kept) {
    FourFloats single;
    narrow(irradiance, single);
    std::memcpy(irradiance_ + at(id), &single, Lanes * sizeof(float));
    widen(single, kept);
    narrow(emission_ + reflectance_ * irradiance, single);
    std::memcpy(radiosity_ + at(id), &single, Lanes * sizeof(float));
  }

  const Node* const nodes_;
  const size_t bands_;
  float *const irradiance_, *const radiosity_;
  FourDoubles emission_, reflectance_;
};

template <int Lanes>
inline void push_pull_some(const PushPullTree& tree, int first_band, double* sum) {
  FourDoubles from_above, all = {};
  take_some<Lanes>(tree.from_above + first_band, from_above);
  double weight = 0;
  TreeSweep<Lanes>(tree, first_band).go(tree.root, from_above, all, weight);
  std::memcpy(sum + first_band, &all, Lanes * sizeof(double));
}

// Four bands at a time.
inline void push_pull(const PushPullTree& tree, double* sum) {
  int band = 0;
  for (; tree.bands - band >= 4; band += 4) push_pull_some<4>(tree, band, sum);
  switch (tree.bands - band) {
    case 3: return push_pull_some<3>(tree, band, sum);
    case 2: return push_pull_some<2>(tree, band, sum);
    case 1: return push_pull_some<1>(tree, band, sum);
    default: return;
  }
}
