// Included once per instruction set, inside its namespace. Four lanes side by side, which never mix:
// the same bits whatever the width of the registers. Floor 7 (stages).

using FourFloats = float __attribute__((vector_size(16)));
using FourDoubles = double __attribute__((vector_size(32)));

inline void widen(const FourFloats& from, FourDoubles& to) {
#ifdef __AVX__
  to = reinterpret_cast<FourDoubles>(_mm256_cvtps_pd(reinterpret_cast<__m128>(from)));
#else
  to = __builtin_convertvector(from, FourDoubles);
#endif
}
inline void widen(const float* from, FourDoubles& to) {
  FourFloats narrow;
  std::memcpy(&narrow, from, sizeof narrow);
  widen(narrow, to);
}
inline void narrow(const FourDoubles& from, FourFloats& to) {
#ifdef __AVX__
  to = reinterpret_cast<FourFloats>(_mm256_cvtpd_ps(reinterpret_cast<__m256d>(from)));
#else
  to = __builtin_convertvector(from, FourFloats);
#endif
}

// The first lanes alone, read without a detour over memory, which would have to wait for the parts;
// those beyond are 0.
template <int Lanes>
inline void widen_some(const float* from, FourDoubles& to) {
  FourFloats narrow = {};
#ifdef __SSE2__
  if (Lanes == 4) return widen(from, to);
  __m128 low = _mm_load_ss(from);
  if (Lanes >= 2) low = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
  narrow = reinterpret_cast<FourFloats>(Lanes == 3 ? _mm_movelh_ps(low, _mm_load_ss(from + 2)) : low);
#else
  std::memcpy(&narrow, from, Lanes * sizeof(float));
#endif
  widen(narrow, to);
}
template <int Lanes>
inline void take_some(const double* from, FourDoubles& to) {
  to = FourDoubles{};
  std::memcpy(&to, from, Lanes * sizeof(double));
}
