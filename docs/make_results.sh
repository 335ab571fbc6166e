#!/usr/bin/env bash
# Runs the tests behind docs/results/README.md: the three models and a thinner overlap.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
prm=drivers/two_scale_triaxial/two_scale_triaxial.prm
./run two_scale_triaxial $prm --output results/grains --set "Model/kind=grains"
./run two_scale_triaxial $prm --output results/continuum --set "Model/kind=continuum"
./run two_scale_triaxial $prm --output results/thin-overlap --no-plots --set "Model/overlap layers=1"
./run two_scale_triaxial $prm --output results/two_scale_triaxial # last: draws the comparison
