#!/usr/bin/env bash
# Tries submit.sh on a Slurm of one node, this machine, and takes it down again. As root, with Debian's slurm-wlm and munge:
#   apt-get install -y slurm-wlm munge
#   tests/slurm/one-node.sh 3 [PATH...]
# The merged report must be the one of a run without Slurm, but for its times. Nothing outside of a scratch folder is changed, but for munge's key
# if there is none.
set -euo pipefail
parts=${1:?how many parts}
shift
here=$(cd "$(dirname "$0")" && pwd)
lancet=${LANCET:-target/release/lancet}
scratch=$(mktemp -d)
pids=()
finish() {
  # The daemons write to the scratch folder until they are gone.
  ((${#pids[@]} == 0)) || { kill "${pids[@]}" && wait "${pids[@]}"; } 2> /dev/null || true
  rm -rf "$scratch"
}
trap finish EXIT

# wait_for WHAT COMMAND...: until it succeeds, half a minute at most.
wait_for() {
  local what=$1
  shift
  for _ in $(seq 60); do
    "$@" > /dev/null 2>&1 && return
    sleep 0.5
  done
  echo "one-node: no $what" >&2
  tail -n 20 "$scratch"/*.log >&2 || true
  exit 2
}

[[ -f /etc/munge/munge.key ]] || mungekey --create
mkdir -p "$scratch/munge" "$scratch/state" "$scratch/spool"
chmod 755 "$scratch" "$scratch/munge"
munged --foreground --force --socket="$scratch/munge/socket" --pid-file="$scratch/munge/pid" \
  --seed-file="$scratch/munge/seed" 2> "$scratch/munged.log" &
pids+=($!)
wait_for munged munge --no-input --socket="$scratch/munge/socket"

host=$(hostname -s)
cat > "$scratch/slurm.conf" << CONF
ClusterName=lancet
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket
CryptoType=crypto/munge
SlurmctldPort=46817
SlurmdPort=46818
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$scratch/slurm.conf
slurmctld -D 2> "$scratch/slurmctld-start.log" &
pids+=($!)
slurmd -D 2> "$scratch/slurmd-start.log" &
pids+=($!)
wait_for 'idle node' sh -c 'sinfo --noheader --format=%T | grep -q idle'

LANCET=$lancet "$here/submit.sh" "$parts" "$scratch/parts" "$@" | tail -n 1
"$lancet" verify "$@" --renderer reference --json "$scratch/whole.json" | tail -n 1
digests() { grep -E '^      "(recording|digest|verdict)"' "$1"; }
diff <(digests "$scratch/parts/report.json") <(digests "$scratch/whole.json")
echo "one-node: $parts parts, $(digests "$scratch/whole.json" | grep -c '"recording"') recordings, the same report as without Slurm"
