#include "model/json.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using namespace mcplan;

TEST_CASE("what is written as JSON reads back the same, to the last bit") {
  std::mt19937_64 rng(3);
  std::normal_distribution<double> normal;
  model::Value::Array numbers;
  for (int i = 0; i < 1000; ++i) numbers.push_back(normal(rng) * std::pow(10.0, i % 40 - 20));
  model::Value data;
  data.set("numbers", numbers);
  data.set("text", "a \"quoted\" \n line");
  data.set("none", model::Value());
  for (int indent : {0, 2})
    CHECK(model::json_text(model::parse_json(model::json_text(data, indent))) == model::json_text(data));
  const model::Value again = model::parse_json(model::json_text(data));
  const auto& back = *again.find("numbers")->get<model::Value::Array>();
  for (std::size_t i = 0; i < numbers.size(); ++i) CHECK(*back[i].get<double>() == *numbers[i].get<double>());
}

TEST_CASE("no text overflows the stack") {
  for (const char* opening : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 200000; ++i) text += opening;
    CHECK_THROWS_WITH_AS(model::parse_json(text), "arrays and objects nested too deep", std::invalid_argument);
  }
}

TEST_CASE("a text of too many values breaks another rule than one that is no JSON") {
  std::string text = "[0";
  for (int i = 0; i < 2000000; ++i) text += ",0";
  CHECK_THROWS_WITH_AS(model::parse_json(text + "]"), "may have 2000000 values at most", std::length_error);
}

TEST_CASE("what is no JSON is said with its place") {
  for (const char* bad : {"", "{", "{\"a\": nan}", "[1,]", "{\"a\": 1} x", "\"\xff\"", "1e999"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(model::parse_json(bad), std::invalid_argument);
  }
}

TEST_CASE("a table has each key once") {
  for (const char* twice :
       {"{\"a\": 1, \"b\": 2, \"a\": 1}", "[{\"a\": [], \"a\": {}}]", "{\"x\": {\"a\": 1, \"\\u0061\": 2}}"}) {
    CAPTURE(twice);
    CHECK_THROWS_WITH_AS(model::parse_json(twice), "the key \"a\" twice", std::invalid_argument);
  }
  CHECK_NOTHROW(model::parse_json("{\"a\": {\"a\": 1}, \"b\": [{\"a\": 1}, {\"a\": 2}]}"));
}
