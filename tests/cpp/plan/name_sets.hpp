#pragma once

#include <doctest/doctest.h>

#include <set>
#include <string>

/// Sets of names, spelt out where a check fails.
namespace doctest {

template <>
struct StringMaker<std::set<std::string>> {
  static String convert(const std::set<std::string>& names) {
    std::string out = "{";
    for (const auto& name : names) out += " " + name;
    return (out + " }").c_str();
  }
};

}  // namespace doctest
