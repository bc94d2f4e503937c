// What a test that fails tells of a structured binding.
#pragma once

#include <doctest/doctest.h>

// As CAPTURE, which is a lambda: in clang before 16 none can use a structured binding.
#define SHOW(x) DUET_SHOW(x, #x, DOCTEST_ANONYMOUS(shown_))
#define DUET_SHOW(x, text, name) \
  const auto& name = x;          \
  INFO(text " := ", name)
