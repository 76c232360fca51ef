// Random numbers of distributions, each from one word of 64 random bits by the inverse of its distribution function, so
// that a draw is a pure function of the word: the same bits everywhere. Parameters are trusted.
#pragma once

#include <cstdint>

namespace tumble {

// Uniform in [low, high].
double uniform(std::uint64_t word, double low, double high);

double normal(std::uint64_t word, double mean, double deviation);

// Its logarithm is uniform; in [low, high], low > 0.
double log_uniform(std::uint64_t word, double low, double high);

// z with P(Z <= z) = p for a standard normal Z, to about 1e-15 of z; p in (0, 1). [Wichura 1988], PPND16.
double normal_quantile(double p);

// Draw `number` of instance `instance` under the seed: word (number mod 4) of philox at the counter
// {number / 4 + 1, instance, 0, 0} with the key {seed, 0}. In Python:
// numpy.random.Philox(counter=[0, instance, 0, 0], key=seed).random_raw(number + 1)[number].
std::uint64_t draw_word(std::uint64_t seed, std::uint64_t instance, std::uint64_t number);

}  // namespace tumble
