// Eight and sixteen numbers at a time, on whatever registers the including file is compiled for.
// Only vertical operations that IEEE 754 defines bit by bit, so that every instruction set gives
// the same results. Included within an unnamed namespace by files that are compiled with their own
// instruction set; uses no inline functions that other files share. Floor 4 (visibility).
#pragma once

using Vector4 = float __attribute__((vector_size(16)));
using Mask4 = int32_t __attribute__((vector_size(16)));
struct Register4 {
  Vector4 v;
};
inline Register4 load_register(const float* p, Register4*) {
  Register4 a;
  __builtin_memcpy(&a.v, p, sizeof a.v);
  return a;
}
inline Register4 spread_register(float s, Register4*) { return {Vector4{s, s, s, s}}; }
inline void store_register(float* p, Register4 a) { __builtin_memcpy(p, &a.v, sizeof a.v); }
inline Register4 operator+(Register4 a, Register4 b) { return {a.v + b.v}; }
inline Register4 operator-(Register4 a, Register4 b) { return {a.v - b.v}; }
inline Register4 operator*(Register4 a, Register4 b) { return {a.v * b.v}; }
inline Register4 operator/(Register4 a, Register4 b) { return {a.v / b.v}; }
#if defined(__SSE2__)
inline Register4 least(Register4 a, Register4 b) { return {_mm_min_ps(a.v, b.v)}; }
inline Register4 greatest(Register4 a, Register4 b) { return {_mm_max_ps(a.v, b.v)}; }
inline uint32_t bits_of(Mask4 m) {
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(m)));
}
#else
inline Register4 least(Register4 a, Register4 b) { return {a.v < b.v ? a.v : b.v}; }
inline Register4 greatest(Register4 a, Register4 b) { return {a.v > b.v ? a.v : b.v}; }
inline uint32_t bits_of(Mask4 m) { return (m[0] & 1u) | (m[1] & 2u) | (m[2] & 4u) | (m[3] & 8u); }
#endif
inline uint32_t less(Register4 a, Register4 b) { return bits_of(a.v < b.v); }
inline uint32_t less_equal(Register4 a, Register4 b) { return bits_of(a.v <= b.v); }
inline Register4 where_negative(Register4 a, Register4 x, Register4 y) {
  return {a.v < Vector4{} ? x.v : y.v};
}
constexpr int lanes_of(Register4*) { return 4; }
#if defined(__AVX2__)

struct Register8 {
  __m256 v;
};
inline Register8 load_register(const float* p, Register8*) { return {_mm256_loadu_ps(p)}; }
inline Register8 spread_register(float s, Register8*) { return {_mm256_set1_ps(s)}; }
inline void store_register(float* p, Register8 a) { _mm256_storeu_ps(p, a.v); }
inline Register8 operator+(Register8 a, Register8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Register8 operator-(Register8 a, Register8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Register8 operator*(Register8 a, Register8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Register8 operator/(Register8 a, Register8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Register8 least(Register8 a, Register8 b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Register8 greatest(Register8 a, Register8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline uint32_t less(Register8 a, Register8 b) {
  return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
}
inline uint32_t less_equal(Register8 a, Register8 b) {
  return static_cast<uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
inline Register8 where_negative(Register8 a, Register8 x, Register8 y) {
  return {_mm256_blendv_ps(y.v, x.v, _mm256_cmp_ps(a.v, _mm256_setzero_ps(), _CMP_LT_OQ))};
}
constexpr int lanes_of(Register8*) { return 8; }
using Half = Register8;

#else
using Half = Register4;
#endif

#if defined(__AVX512F__)

struct Register16 {
  __m512 v;
};
inline Register16 load_register(const float* p, Register16*) { return {_mm512_loadu_ps(p)}; }
inline Register16 spread_register(float s, Register16*) { return {_mm512_set1_ps(s)}; }
inline void store_register(float* p, Register16 a) { _mm512_storeu_ps(p, a.v); }
inline Register16 operator+(Register16 a, Register16 b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Register16 operator-(Register16 a, Register16 b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Register16 operator*(Register16 a, Register16 b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Register16 operator/(Register16 a, Register16 b) { return {_mm512_div_ps(a.v, b.v)}; }
inline Register16 least(Register16 a, Register16 b) {
  return {_mm512_maskz_min_ps(0xffff, a.v, b.v)};
}
inline Register16 greatest(Register16 a, Register16 b) {
  return {_mm512_maskz_max_ps(0xffff, a.v, b.v)};
}
inline uint32_t less(Register16 a, Register16 b) {
  return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ);
}
inline uint32_t less_equal(Register16 a, Register16 b) {
  return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ);
}
inline Register16 where_negative(Register16 a, Register16 x, Register16 y) {
  return {_mm512_mask_blend_ps(_mm512_cmp_ps_mask(a.v, _mm512_setzero_ps(), _CMP_LT_OQ), y.v, x.v)};
}
constexpr int lanes_of(Register16*) { return 16; }
using Whole = Register16;

#else
using Whole = Half;
#endif

// N numbers in as many registers as that takes.
template <class Register, int N>
struct Lanes {
  static constexpr int width = lanes_of(static_cast<Register*>(nullptr));
  static constexpr int parts = N / width;
  Register part[parts];

  static Lanes load(const float* p) {
    Lanes r;
    for (int i = 0; i < parts; ++i)
      r.part[i] = load_register(p + i * width, static_cast<Register*>(nullptr));
    return r;
  }
  static Lanes all(float s) {
    Lanes r;
    for (int i = 0; i < parts; ++i) r.part[i] = spread_register(s, static_cast<Register*>(nullptr));
    return r;
  }
  void store(float* p) const {
    for (int i = 0; i < parts; ++i) store_register(p + i * width, part[i]);
  }
  // part[i] = operation(a.part[i], b.part[i])
  template <class Operation>
  static Lanes each(const Lanes& a, const Lanes& b, Operation operation) {
    Lanes r;
    for (int i = 0; i < parts; ++i) r.part[i] = operation(a.part[i], b.part[i]);
    return r;
  }
  template <class Comparison>
  static uint32_t bits(const Lanes& a, const Lanes& b, Comparison comparison) {
    uint32_t r = 0;
    for (int i = 0; i < parts; ++i) r |= comparison(a.part[i], b.part[i]) << (i * width);
    return r;
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return each(a, b, [](Register x, Register y) { return x + y; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return each(a, b, [](Register x, Register y) { return x - y; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return each(a, b, [](Register x, Register y) { return x * y; });
  }
  friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return each(a, b, [](Register x, Register y) { return x / y; });
  }
  friend Lanes least(const Lanes& a, const Lanes& b) {
    return each(a, b, [](Register x, Register y) { return least(x, y); });
  }
  friend Lanes greatest(const Lanes& a, const Lanes& b) {
    return each(a, b, [](Register x, Register y) { return greatest(x, y); });
  }
  // a[i] < 0 ? x[i] : y[i]
  friend Lanes where_negative(const Lanes& a, const Lanes& x, const Lanes& y) {
    Lanes r;
    for (int i = 0; i < parts; ++i) r.part[i] = where_negative(a.part[i], x.part[i], y.part[i]);
    return r;
  }
  // Bit i: a[i] < b[i]; false when one is not a number.
  friend uint32_t less(const Lanes& a, const Lanes& b) {
    return bits(a, b, [](Register x, Register y) { return less(x, y); });
  }
  friend uint32_t less_equal(const Lanes& a, const Lanes& b) {
    return bits(a, b, [](Register x, Register y) { return less_equal(x, y); });
  }
};

using Four = Lanes<Register4, 4>;
using Eight = Lanes<Half, 8>;
using Sixteen = Lanes<Whole, 16>;

// Lanes of a (0 to 3) and of b (4 to 7).
template <int i, int j, int k, int l>
Vector4 picked(Vector4 a, Vector4 b) {
#ifdef __clang__
  return __builtin_shufflevector(a, b, i, j, k, l);
#else
  using Order = int32_t __attribute__((vector_size(16)));
  return __builtin_shuffle(a, b, Order{i, j, k, l});
#endif
}

// The four rows of a square become its columns.
inline void transpose(Four* rows) {
  const Vector4 a = rows[0].part[0].v, b = rows[1].part[0].v;
  const Vector4 c = rows[2].part[0].v, d = rows[3].part[0].v;
  const Vector4 low_ab = picked<0, 4, 1, 5>(a, b);
  const Vector4 high_ab = picked<2, 6, 3, 7>(a, b);
  const Vector4 low_cd = picked<0, 4, 1, 5>(c, d);
  const Vector4 high_cd = picked<2, 6, 3, 7>(c, d);
  rows[0].part[0].v = picked<0, 1, 4, 5>(low_ab, low_cd);
  rows[1].part[0].v = picked<2, 3, 6, 7>(low_ab, low_cd);
  rows[2].part[0].v = picked<0, 1, 4, 5>(high_ab, high_cd);
  rows[3].part[0].v = picked<2, 3, 6, 7>(high_ab, high_cd);
}
