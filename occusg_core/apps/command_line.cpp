// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.hpp"

#include <iostream>
#include <limits>
#include <typeinfo>

#include "occusg/parameter.hpp"
#include "occusg/pipeline/config_file.hpp"

namespace occusg::apps {
namespace po = boost::program_options;
namespace {

/// "--name", as the user writes it.
std::string dashed(const std::string& name) {
  return name.rfind("--", 0) == 0 ? name : "--" + name;
}

std::string sentenceOn(const po::unknown_option& error, const po::options_description& options) {
  std::vector<std::string> names;
  names.reserve(options.options().size());
  for (const auto& option : options.options()) names.push_back(dashed(option->long_name()));
  const std::string unknown = error.get_option_name();
  const std::string suggestion = suggestionFor(dashed(unknown), names);
  return "unknown option '" + unknown + "'" +
         (suggestion.empty() ? std::string() : "; " + suggestion);
}

/// What the option is for, from its help.
std::string purposeOf(const std::string& name, const po::options_description& options) {
  const po::option_description* option = options.find_nothrow(name, false);
  return option == nullptr ? std::string() : option->description();
}

/// The value in "the argument ('VALUE') for option ...", which the library tells in no other way.
std::string refusedValue(const std::string& sentence) {
  const std::string beginning = "('";
  const std::size_t start = sentence.find(beginning);
  const std::size_t end = sentence.rfind("')");
  if (start == std::string::npos || end == std::string::npos || end < start + beginning.size())
    return "";
  return sentence.substr(start + beginning.size(), end - start - beginning.size());
}

/// What the option takes, as far as its type tells.
std::string valueNeededBy(const std::string& name, const po::options_description& options) {
  const po::option_description* option = options.find_nothrow(name, false);
  if (option == nullptr) return "another value is needed";
  const auto* semantic = dynamic_cast<const po::typed_value_base*>(option->semantic().get());
  if (semantic != nullptr && semantic->value_type() == typeid(int)) {
    return "a whole number from " + std::to_string(std::numeric_limits<int>::min()) + " to " +
           std::to_string(std::numeric_limits<int>::max()) + " is needed";
  }
  return "a number, as in 0.05, is needed";
}

/// An option's name without its dashes.
std::string bare(std::string name) {
  name.erase(0, name.find_first_not_of('-'));
  return name;
}

void read(po::variables_map& values, const std::vector<std::string>& arguments,
          const po::options_description& all,
          const po::positional_options_description& positionals) {
  namespace style = po::command_line_style;
  po::store(po::command_line_parser(arguments)
                .options(all)
                .positional(positionals)
                .style(style::unix_style & ~style::allow_guessing)
                .run(),
            values);
}

/// @throws UsageError with a sentence for each way in which arguments can be wrong.
template <typename Step>
void explained(const Step& step, const CommandHelp& help, const po::options_description& options) {
  const std::string form = "the form is '" + help.synopsis + "'";
  try {
    step();
  } catch (const po::too_many_positional_options_error&) {
    throw UsageError("there are too many arguments; " + form);
  } catch (const po::unknown_option& error) {
    throw UsageError(sentenceOn(error, options));
  } catch (const po::required_option& error) {
    const std::string name = bare(error.get_option_name());
    throw UsageError("--" + name + " is missing (" + purposeOf(name, options) + "); " + form);
  } catch (const po::invalid_option_value& error) {
    const std::string name = bare(error.get_option_name());
    throw UsageError("--" + name + " is '" + refusedValue(error.what()) + "'; " +
                     valueNeededBy(name, options) + " (" + purposeOf(name, options) + ")");
  } catch (const po::multiple_occurrences& error) {
    throw UsageError(error.get_option_name() + " is given more than once; give it once");
  } catch (const po::invalid_command_line_syntax& error) {
    const std::string name = bare(error.get_option_name());
    if (error.kind() == po::invalid_syntax::missing_parameter ||
        error.kind() == po::invalid_syntax::empty_adjacent_parameter)
      throw UsageError("--" + name + " needs a value: " + purposeOf(name, options));
    throw UsageError(error.what());
  } catch (const po::error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

po::variables_map parse(const std::vector<std::string>& arguments, const CommandHelp& help,
                        po::options_description options) {
  options.add_options()("help,h", "show this text");
  po::options_description all;
  all.add(options);
  po::positional_options_description positionals;
  for (const std::string& name : help.positionals) {
    all.add_options()(name.c_str(), po::value<std::string>());
    positionals.add(name.c_str(), 1);
  }
  if (!help.repeated.empty()) {
    all.add_options()(help.repeated.c_str(), po::value<std::vector<std::string>>());
    positionals.add(help.repeated.c_str(), -1);
  }

  po::variables_map values;
  explained([&] { read(values, arguments, all, positionals); }, help, options);
  if (values.count("help") > 0) {
    std::cout << "Usage: " << help.synopsis << "\n\n" << help.description << "\n" << options;
    return {};
  }
  std::vector<std::string> required = help.positionals;
  if (!help.repeated.empty()) required.push_back(help.repeated);
  for (const std::string& name : required) {
    if (values.count(name) == 0)
      throw UsageError(name + " is missing; the form is '" + help.synopsis + "'");
  }
  explained([&] { po::notify(values); }, help, options);
  return values;
}

void addOutputOption(po::options_description& options) {
  options.add_options()("output,o", po::value<std::string>()->required(),
                        "folder for the results; created when missing");
}

void addConfigOption(po::options_description& options) {
  options.add_options()("config", po::value<std::string>()->default_value("default"),
                        "'default', 'paper' or a YAML file (see 'occusg config --print')")(
      "param", po::value<std::vector<std::string>>()->composing(),
      "KEY=VALUE: sets one parameter, over --config; can be repeated");
}

void addDecomposerOption(po::options_description& options) {
  options.add_options()("decomposer", po::value<std::string>(), "overrides regions.decomposer");
}

PipelineConfig overridden(const PipelineConfig& config, const po::variables_map& values,
                          const std::string& option, const std::string& key) {
  const auto text = given<std::string>(values, option);
  if (!text) return config;
  return configFromYaml(key + ": " + *text + "\n", "--" + option, config);
}

PipelineConfig givenConfig(const po::variables_map& values) {
  PipelineConfig config = loadConfig(values["config"].as<std::string>());
  if (values.count("param") == 0) return config;
  for (const std::string& text : values["param"].as<std::vector<std::string>>()) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      throw UsageError("--param is '" + text +
                       "'; KEY=VALUE is needed, as in regions.decomposer=dude");
    }
    config = configFromYaml(text.substr(0, equals) + ": " + text.substr(equals + 1) + "\n",
                            "--param " + text, config);
  }
  return config;
}

}  // namespace occusg::apps
