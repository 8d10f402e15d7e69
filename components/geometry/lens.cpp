#include "components/geometry/lens.hpp"

namespace omma {}
