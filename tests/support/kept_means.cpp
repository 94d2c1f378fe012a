#include <tests/support/kept_means.h>
#include <tests/support/paths.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace wend::test {

// Lines are name,mean,standard error,mean,standard error,...
std::vector<KnownMean> kept_means(const std::string& name, const std::function<std::vector<KnownMean>()>& measure) {
    const auto path = source_dir() / "tests/support/means.csv";
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream fields(line);
        std::string field;
        if (std::getline(fields, field, ',') && field == name) {
            std::vector<KnownMean> means;
            char comma;
            for (KnownMean m; fields >> m.mean >> comma >> m.standard_error; fields >> comma) {
                means.push_back(m);
            }
            EXPECT_FALSE(means.empty()) << name;
            return means;
        }
    }
    const char* wish = std::getenv("WEND_MEANS");
    if (!wish || std::string(wish) != "record") {
        throw std::runtime_error(path.string() + " has no " + name + ": run the test once with WEND_MEANS=record");
    }
    const std::vector<KnownMean> means = measure();
    std::ofstream out(path, std::ios::app);
    out << name << std::setprecision(9);
    for (const KnownMean& m : means) {
        out << ',' << m.mean << ',' << m.standard_error;
    }
    out << '\n';
    return means;
}

}  // namespace wend::test
