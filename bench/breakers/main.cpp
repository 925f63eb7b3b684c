// netmesh against the inputs that break other mesh generators.
//
//   breakers                   every case; the table goes to the standard output
//     --found DIRECTORY        also the cases of that directory
//     --only TEXT              only cases whose row would begin with "NAME dim OUTPUT" holding TEXT
//     --seed N                 other points of the same kinds (default 1)
//     --jobs N                 processes at a time (default 1)
//     --wall-limit SECONDS     of each (default 120)
//     --shrink                 instead of the table: the points of the first failing case, as few as do
//
// Ends with 1 if a case fails.
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "child.hpp"
#include "shrink.hpp"
#include "table.hpp"
#include "verdict.hpp"

std::size_t usual_size(unsigned dim) { return dim == 2 ? 1000 : dim == 3 ? 480 : dim == 4 ? 240 : 64; }

namespace {

struct Arguments {
    std::string found, only;
    std::uint64_t seed = 1;
    unsigned jobs = 1, wall_limit = 120;
    bool shrink = false;
};

Arguments read_arguments(int count, char** words) {
    Arguments arguments;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--shrink") {
            arguments.shrink = true;
            continue;
        }
        const char* value = i + 1 < count ? words[++i] : "";
        if (word == "--found") arguments.found = value;
        else if (word == "--only") arguments.only = value;
        else if (word == "--seed") arguments.seed = std::strtoull(value, nullptr, 10);
        else if (word == "--jobs") arguments.jobs = static_cast<unsigned>(std::atoi(value));
        else if (word == "--wall-limit") arguments.wall_limit = static_cast<unsigned>(std::atoi(value));
        else {
            std::fprintf(stderr, "breakers: no option '%s'\n", word.c_str());
            std::exit(2);
        }
    }
    if (arguments.jobs == 0 || arguments.wall_limit == 0) std::exit(2);
    return arguments;
}

std::string title(const Trial& trial) {
    return trial.what.name + " " + std::to_string(trial.what.dim) + "D " + output_name(trial.output);
}

std::vector<Case> all_cases(const Arguments& arguments) {
    std::vector<Case> cases;
    const auto add = [&](std::vector<Case> more) {
        cases.insert(cases.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    };
    for (const unsigned dim : {2u, 3u, 4u}) {
        add(scale_cases(dim, arguments.seed));
        add(position_cases(dim, arguments.seed));
        add(refused_cases(dim, arguments.seed));
    }
    add(position_cases(5, arguments.seed));
    if (!arguments.found.empty()) add(found_cases(arguments.found));
    return cases;
}

// A well-spaced mesh of a large spread is long: the limit on vertices is then the answer, and comes
// sooner where vertices are dear.
std::uint64_t vertex_limit(unsigned dim, nm_output output) {
    if (output == NM_OUTPUT_HIERARCHICAL) return 300000;
    return dim <= 3 ? 300000 : 40000;
}

std::vector<Trial> all_trials(const Arguments& arguments) {
    std::vector<Trial> trials;
    for (const Case& what : all_cases(arguments)) {
        for (const nm_output output : {NM_OUTPUT_HIERARCHICAL, NM_OUTPUT_WELL_SPACED}) {
            const bool refused = what.expected == Expected::non_finite || what.expected == Expected::degenerate;
            if (output == NM_OUTPUT_WELL_SPACED && (refused || what.dim > 4)) continue;
            trials.push_back({what, output, vertex_limit(what.dim, output), arguments.wall_limit});
            if (title(trials.back()).find(arguments.only) == std::string::npos) trials.pop_back();
        }
    }
    return trials;
}

// The memory of uniform points, by number, dimension and output.
class GenericCases {
public:
    GenericCases(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes, unsigned jobs) {
        std::vector<Trial> generic;
        for (std::size_t i = 0; i < trials.size(); ++i) {
            const std::size_t n = static_cast<std::size_t>(outcomes[i].inputs);
            const unsigned dim = trials[i].what.dim;
            if (n < 2 || !index_.insert({{n, dim, trials[i].output}, generic.size()}).second) continue;
            Trial trial = trials[i];
            trial.what = {"uniform", dim, Expected::mesh, [=] { return generate("uniform", dim, n); }, ""};
            generic.push_back(trial);
        }
        outcomes_ = run_in_children(generic, jobs, [](std::size_t, const Outcome&) {});
    }

    const Outcome& of(const Trial& trial, const Outcome& outcome) const {
        static const Outcome none{};
        const auto found = index_.find({static_cast<std::size_t>(outcome.inputs), trial.what.dim, trial.output});
        return found == index_.end() ? none : outcomes_[found->second];
    }

private:
    std::map<std::tuple<std::size_t, unsigned, nm_output>, std::size_t> index_;
    std::vector<Outcome> outcomes_;
};

int print_shrunk(const std::vector<Trial>& trials, unsigned jobs) {
    for (const Trial& trial : trials) {
        const Outcome outcome = run_in_children({trial}, 1, [](std::size_t, const Outcome&) {})[0];
        const std::string wrong = failure_of_itself(trial, outcome);
        if (wrong.empty()) continue;
        const PointSet points = shrink(trial, jobs);
        std::printf("# %s: %s\n", title(trial).c_str(), wrong.c_str());
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (unsigned k = 0; k < points.dim; ++k) std::printf(k == 0 ? "%a" : " %a", points.point(i)[k]);
            std::printf("\n");
        }
        return 1;
    }
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const Arguments arguments = read_arguments(count, words);
    const std::vector<Trial> trials = all_trials(arguments);
    if (arguments.shrink) return print_shrunk(trials, arguments.jobs);
    std::size_t ended = 0;
    const auto finished = [&](std::size_t index, const Outcome& outcome) {
        std::fprintf(stderr, "%zu/%zu %s: %s %.2f s %s\n", ++ended, trials.size(), title(trials[index]).c_str(),
                     nm_status_name(outcome.status), outcome.seconds,
                     failure_of_itself(trials[index], outcome).c_str());
    };
    const std::vector<Outcome> outcomes = run_in_children(trials, arguments.jobs, finished);
    const GenericCases generic(trials, outcomes, arguments.jobs);
    std::fputs(table_head().c_str(), stdout);
    std::size_t failed = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const Outcome& reference = generic.of(trials[i], outcomes[i]);
        std::fputs(table_row(trials[i], outcomes[i], reference).c_str(), stdout);
        failed += !failure(trials[i], outcomes[i], reference).empty();
    }
    std::printf("\n%zu rows, %zu failed.\n", trials.size(), failed);
    return failed == 0 && !trials.empty() ? 0 : 1;
}
