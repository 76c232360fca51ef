// Random numbers without a state: what a counter and a key are mixed to. Philox4x64-10 of [Salmon et al. 2011].
#pragma once

#include <array>
#include <cstdint>

namespace tumble {

// Four independent words, uniform over 64 bits. Those of numpy.random.Philox(counter=c, key=key).random_raw(4) are of
// the counter c + 1, as numpy counts before it draws.
inline std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> counter, std::array<std::uint64_t, 2> key) {
  __extension__ using Uint128 = unsigned __int128;
  constexpr int num_rounds = 10;
  for (int round = 0; round < num_rounds; ++round) {
    const Uint128 product_0 = static_cast<Uint128>(0xd2e7470ee14c6c93u) * counter[0];
    const Uint128 product_1 = static_cast<Uint128>(0xca5a826395121157u) * counter[2];
    counter = {static_cast<std::uint64_t>(product_1 >> 64) ^ counter[1] ^ key[0], static_cast<std::uint64_t>(product_1),
               static_cast<std::uint64_t>(product_0 >> 64) ^ counter[3] ^ key[1],
               static_cast<std::uint64_t>(product_0)};
    key[0] += 0x9e3779b97f4a7c15u;
    key[1] += 0xbb67ae8584caa73bu;
  }
  return counter;
}

}  // namespace tumble
