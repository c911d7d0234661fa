// Included once per instruction set, inside its namespace. Four lanes side by side, which never mix:
// the same bits whatever the width of the registers. Floor 7 (stages).

using FourFloats = float __attribute__((vector_size(16)));
using FourDoubles = double __attribute__((vector_size(32)));

template <int Bands>
inline void gather_runs_of(const Link* links, const uint32_t* first, size_t runs, uint32_t end,
                           const float* sources, float* out) {
  const FourFloats* const four = reinterpret_cast<const FourFloats*>(sources);
  for (size_t k = 0; k < runs; ++k) {
    const Link* link = links + first[k];
    const Link* const last = links + (k + 1 < runs ? first[k + 1] : end);
    FourDoubles sum = {};
    for (; link != last; ++link) {
      const double weight = link->weight;
      sum += weight * __builtin_convertvector(four[static_cast<uint32_t>(link->source)], FourDoubles);
    }
    for (int b = 0; b < Bands; ++b) out[k * Bands + b] = static_cast<float>(sum[b]);
  }
}

inline void gather_runs(const Link* links, const uint32_t* first, size_t runs, uint32_t end,
                        const float* sources, int bands, float* out) {
  if (bands == 2) return gather_runs_of<2>(links, first, runs, end, sources, out);
  if (bands == 3) return gather_runs_of<3>(links, first, runs, end, sources, out);
  gather_runs_of<4>(links, first, runs, end, sources, out);
}
