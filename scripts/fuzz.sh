#!/bin/sh
# fuzz.sh BUILD SECONDS: run every fuzzer of a fuzz build for that long, one after the other; inputs found stay in BUILD/corpus.
set -eu
build=$1; seconds=$2
failed=0
for fuzzer in "$build"/tests/fuzz/fuzz_*; do
  [ -x "$fuzzer" ] && [ -f "$fuzzer" ] || continue
  name=$(basename "$fuzzer")
  mkdir -p "$build/corpus/$name"
  case $name in
    fuzz_lcp_text | fuzz_exact_lcp_text) printf 'M\n2 1\n1 2\nq\n-1 -1/2\n' >"$build/corpus/$name/seed" ;;
    fuzz_record_npz) cp tests/output/data/*.npz "$build/corpus/$name/" ;;
  esac
  echo "$name: $seconds s"
  if ! "$fuzzer" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -verbosity=0 -print_final_stats=1 \
      -artifact_prefix="$build/$name-" "$build/corpus/$name" 2>"$build/$name.log"; then
    failed=1
    tail -n 30 "$build/$name.log"
  fi
  grep -a 'number_of_executed_units' "$build/$name.log" || true
done
exit $failed
