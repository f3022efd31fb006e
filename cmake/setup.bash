# SPDX-License-Identifier: BSD-3-Clause
# Brings this installation of OccuSG into a bash session: source setup.bash
OCCUSG_PREFIX=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$OCCUSG_PREFIX/setup.sh"
