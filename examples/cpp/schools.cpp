// SPDX-License-Identifier: Apache-2.0
// Detects the schools of a survey and prints them: observation, number, pings, mean Sv and where the product lies.
//   schools SURVEY FOLDER [NAME=VALUE]...      e.g. schools raw products detect.tolerance_db=8.5
#include <sonar_explorer/error.h>
#include <sonar_explorer/schools.h>
#include <sonar_explorer/version.h>

#include <filesystem>
#include <iomanip>
#include <iostream>

namespace se = sonar_explorer;

#if SONAR_EXPLORER_VERSION < 200
#error "columns are read by name since 0.2.0"
#endif

namespace {

/// Values of a column, which may hold numbers or whole numbers.
double number(const se::Table& table, const std::string& column, std::size_t row) {
  for (const se::Column& one : table) {
    if (one.name != column) continue;
    if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&one.values))
      return static_cast<double>(whole->at(row));
    return std::get<std::vector<double>>(one.values).at(row);
  }
  throw se::Error("the table has no column " + column, "usage");
}

std::size_t rows(const se::Table& table) {
  return table.empty() ? 0 : std::visit([](const auto& values) { return values.size(); }, table.front().values);
}

/// Loudest sample of a ping, dB: what a display would begin with.
double loudest_db(const se::Ping& ping) {
  std::int16_t loudest = se::kNoData;
  for (std::size_t i = 0; i < ping.sv().size(); ++i) {
    if (ping.flags()[i] == 0 && ping.sv()[i] > loudest) loudest = ping.sv()[i];
  }
  return loudest * se::kDbPerCount;
}

void show(const se::Observation& observation, const std::filesystem::path& folder) {
  if (!observation.grid()) return;
  std::cout << observation.name() << ": " << observation.pings() << " pings of " << observation.sounder() << ", up to "
            << loudest_db(observation.ping(0)) << " dB in the first\n";
  const se::Product product = se::detect(observation);
  const se::Table schools = product.schools();
  for (std::size_t row = 0; row < rows(schools); ++row) {
    std::cout << observation.name() << ',' << number(schools, "school_id", row) << ','
              << number(schools, "n_pings", row) << ',' << number(schools, "sv_mean_db", row) << '\n';
  }
  const auto file = folder / (observation.name() + ".nc");
  product.write(file);
  std::cout << observation.name() << ": " << file.string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: schools SURVEY FOLDER [NAME=VALUE]...\n";
    return 2;
  }
  try {
    se::Recipe recipe;
    for (int i = 3; i < argc; ++i) {
      const std::string setting = argv[i];
      const auto equals = setting.find('=');
      if (equals == std::string::npos) throw se::Error(setting + ": expected NAME=VALUE", "usage");
      recipe = recipe.with(setting.substr(0, equals), setting.substr(equals + 1));
    }
    std::filesystem::create_directories(argv[2]);
    std::cout << "sonar_explorer " << se::version() << std::fixed << std::setprecision(2) << '\n';
    const se::Survey survey = se::Survey::open({argv[1]}, recipe);
    for (const se::Observation& observation : survey.observations()) show(observation, argv[2]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
