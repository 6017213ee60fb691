# shellcheck shell=bash
# A real Slurm of one node on the loopback device, everything in one folder. Sourced; needs root.
#   start_slurm FOLDER    exports SLURM_CONF; slurm_processes has every daemon's number
#   stop_slurm FOLDER     every daemon is gone afterwards

start_slurm() {
  local folder=$1 port=$((20000 + $$ % 10000)) cores
  cores=$(nproc)
  mkdir -p "$folder"/{state,spool,log,munge}
  chmod 755 "$folder"
  chmod 711 "$folder/munge"
  dd if=/dev/urandom of="$folder/munge/key" bs=1 count=1024 status=none
  chmod 400 "$folder/munge/key"
  munged --force --socket="$folder/munge/socket" --key-file="$folder/munge/key" \
    --log-file="$folder/log/munged.log" --pid-file="$folder/munged.pid" \
    --seed-file="$folder/munge/seed" --num-threads=2 2>"$folder/log/munged.err" || return 1
  cat >"$folder/slurm.conf" <<CONF
ClusterName=towbench
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CryptoType=crypto/munge
MpiDefault=none
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmdParameters=config_overrides
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1,sched_min_interval=0
CompleteWait=0
ReturnToService=2
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.log
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
KillWait=5
NodeName=localhost NodeAddr=127.0.0.1 NodeHostname=$(hostname -s) CPUs=$cores RealMemory=1000 State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$folder/slurm.conf
  slurmctld -f "$SLURM_CONF" 2>"$folder/log/slurmctld.err" || return 1
  slurmd -f "$SLURM_CONF" -N localhost 2>"$folder/log/slurmd.err" || return 1
  local try
  for ((try = 0; try < 150; ++try)); do
    if [[ $(sinfo --noheader --format=%T 2>/dev/null) == idle ]]; then
      # shellcheck disable=SC2034  # for who sources this
      slurm_processes=$(cat "$folder"/*.pid "$folder/munged.pid" | sort -u)
      return 0
    fi
    sleep 0.2
  done
  tail -n 5 "$folder"/log/* >&2
  return 1
}

stop_slurm() {
  local folder=$1 daemon process try
  for daemon in slurmd slurmctld munged; do
    process=$(cat "$folder/$daemon.pid" 2>/dev/null) || continue
    kill "$process" 2>/dev/null
    for ((try = 0; try < 100; ++try)); do
      kill -0 "$process" 2>/dev/null || break
      sleep 0.1
    done
    kill -9 "$process" 2>/dev/null
  done
  return 0
}
