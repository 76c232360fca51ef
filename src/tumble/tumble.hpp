// All public headers.
#pragma once

#include "tumble/drop/drop.hpp"
#include "tumble/drop/parameters.hpp"
#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/lemke_lu.hpp"
#include "tumble/lcp/methods.hpp"
#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/problem_text.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/result.hpp"
#include "tumble/lcp/solve.hpp"
#include "tumble/math/sin_cos.hpp"
#include "tumble/math/vector.hpp"
