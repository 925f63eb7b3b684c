// Random numbers that are the same on every machine and with every standard library: a 64-bit
// counter through a mixing function.
#ifndef NETMESH_TESTS_RANDOM_HPP
#define NETMESH_TESTS_RANDOM_HPP

#include <array>
#include <cmath>
#include <cstdint>

class Random {
public:
    explicit Random(std::uint64_t seed) : counter_(mix(seed + 1)) {}

    std::uint64_t bits() {
        counter_ += 0x9E3779B97F4A7C15u;  // 2^64 over the golden ratio: the counter visits everything
        return mix(counter_);
    }

    // In [0, 1), a multiple of 2^-53.
    double unit() { return std::ldexp(static_cast<double>(bits() >> 11), -53); }

    // In [0, bound); the bias of the remainder is of no account here.
    std::uint64_t below(std::uint64_t bound) { return bits() % bound; }

    double gaussian() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
        return radius * std::cos(6.283185307179586 * unit());
    }

    // A uniform direction of the unit sphere; the first dim entries count.
    std::array<double, 8> direction(unsigned dim) {
        for (;;) {
            std::array<double, 8> vector{};
            double square = 0.0;
            for (unsigned k = 0; k < dim; ++k) {
                vector[k] = gaussian();
                square += vector[k] * vector[k];
            }
            if (square > 1e-6) {
                for (double& x : vector) x /= std::sqrt(square);
                return vector;
            }
        }
    }

private:
    static std::uint64_t mix(std::uint64_t x) {
        x = (x ^ (x >> 32)) * 0xD6E8FEB86659FD93u;
        x = (x ^ (x >> 32)) * 0xD6E8FEB86659FD93u;
        return x ^ (x >> 32);
    }

    std::uint64_t counter_;
};

#endif
