// Generators for tests of samplers: one replays chosen numbers, one counts what is drawn. Both go wherever code takes a
// generator.
#pragma once

#include <wend/core/random.h>

#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

namespace wend::test {

/// Replays the given uniform numbers in order, so that a test can hit 0, a bin's edge or the largest float below 1.
/// Throws std::out_of_range when more are drawn than were given.
class ScriptedRandom {
public:
    ScriptedRandom(std::initializer_list<float> numbers) : numbers_(numbers) {}
    explicit ScriptedRandom(std::vector<float> numbers) : numbers_(std::move(numbers)) {}

    float uniform() {
        if (drawn_ == numbers_.size()) {
            throw std::out_of_range("ScriptedRandom: all given numbers are used up");
        }
        return numbers_[drawn_++];
    }
    Vec2 uniform2() {
        const float x = uniform();
        return {x, uniform()};
    }

    /// Numbers not drawn yet.
    std::size_t remaining() const { return numbers_.size() - drawn_; }

private:
    std::vector<float> numbers_;
    std::size_t drawn_ = 0;
};

/// Passes another generator's numbers on and counts them, so that a sampler's cost in random numbers is a tested fact.
template <class Generator = Pcg32>
class CountingRandom {
public:
    explicit CountingRandom(Generator generator) : generator_(std::move(generator)) {}

    float uniform() {
        ++count_;
        return generator_.uniform();
    }
    Vec2 uniform2() {
        count_ += 2;
        return generator_.uniform2();
    }

    std::size_t count() const { return count_; }

private:
    Generator generator_;
    std::size_t count_ = 0;
};

}  // namespace wend::test
