#include "core/base/vector_width.h"

#include <cpuid.h>

namespace dmpc::core {
namespace {

/// Tests the parts of x86-64-v3 and of Highway's AVX2 target that compilers have no names for: F16C, MOVBE, AES and LZCNT. Other
/// processors execute LZCNT as BSR, with different results.
bool has_small_instructions() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned basic = bit_F16C | bit_MOVBE | bit_AES | bit_PCLMUL, extended = 0x80000001U;
  const bool has_basic = __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & basic) == basic;
  return has_basic && __get_cpuid(extended, &a, &b, &c, &d) != 0 && (c & bit_LZCNT) != 0;
}

VectorWidth widest() {
  __builtin_cpu_init();
  const bool has_256 = has_small_instructions() && __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi") != 0 &&
                       __builtin_cpu_supports("bmi2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool has_512 = has_256 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                       __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                       __builtin_cpu_supports("avx512vl") != 0;
  return has_512 ? VectorWidth::bits_512 : has_256 ? VectorWidth::bits_256 : VectorWidth::any;
}

}  // namespace

VectorWidth vector_width() {
  static const VectorWidth width = widest();
  return width;
}

}  // namespace dmpc::core
