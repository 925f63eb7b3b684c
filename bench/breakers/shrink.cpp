#include "shrink.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "child.hpp"
#include "verdict.hpp"

namespace {

// The points without those from begin to end.
PointSet without(const PointSet& points, std::size_t begin, std::size_t end) {
    PointSet rest{points.dim, {}, false};
    const auto start = points.coordinates.begin();
    const auto at = [&](std::size_t i) { return start + static_cast<std::ptrdiff_t>(i * points.dim); };
    rest.coordinates.assign(start, at(begin));
    rest.coordinates.insert(rest.coordinates.end(), at(end), points.coordinates.end());
    return rest;
}

// The failure without its figures: what must stay the same.
std::string kind_of(const Trial& trial, const Outcome& outcome) {
    std::string kind = failure_of_itself(trial, outcome);
    kind.erase(std::remove_if(kind.begin(), kind.end(), [](char c) { return c >= '0' && c <= '9'; }), kind.end());
    return kind.substr(0, 24);
}

}  // namespace

PointSet shrink(const Trial& trial, unsigned jobs) {
    const auto silent = [](std::size_t, const Outcome&) {};
    const std::string kind = kind_of(trial, run_in_children({trial}, 1, silent)[0]);
    PointSet points = trial.what.points();
    if (kind.empty()) return points;
    for (std::size_t step = std::max<std::size_t>(points.size() / 2, 1);;) {
        bool shorter = false;
        for (std::size_t begin = 0; begin < points.size();) {
            // A few removals at a time, of which the first that still fails counts.
            std::vector<Trial> trials;
            std::vector<PointSet> candidates;
            for (std::size_t at = begin; at < points.size() && trials.size() < jobs; at += step) {
                candidates.push_back(without(points, at, std::min(at + step, points.size())));
                trials.push_back(trial);
                trials.back().what.points = [rest = candidates.back()] { return rest; };
            }
            const std::vector<Outcome> outcomes = run_in_children(trials, jobs, silent);
            std::size_t which = 0;
            while (which < trials.size() && kind_of(trials[which], outcomes[which]) != kind) ++which;
            begin += which * step;
            if (which < trials.size()) {
                points = candidates[which];
                shorter = true;
            }
        }
        std::fprintf(stderr, "%zu points, steps of %zu\n", points.size(), step);
        if (step == 1 && !shorter) return points;
        step = std::max<std::size_t>(step / 2, 1);
    }
}
