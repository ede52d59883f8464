# SPDX-License-Identifier: MIT
# shellcheck shell=bash
#
# A Slurm cluster of two nodes on this machine, for tests: all of its files lie in one folder, its ports
# are on loopback, and it ends with the test. Sourced after lib.sh, which sets work and logs.
# shellcheck disable=SC2154

cluster=$work/cluster
cluster_pids=()
PATH=$PATH:/usr/sbin:/sbin

need_slurm() {
    local tool
    for tool in munged slurmctld slurmd sbatch squeue scancel scontrol sinfo; do
        type -P "$tool" >"$logs/which" || skip "there is no $tool; ./dev farm installs Slurm"
    done
}

# A free port, below those that the system assigns itself.
free_port() {
    local port
    for _ in {1..100}; do
        port=$((10000 + (RANDOM * 32768 + RANDOM) % 20000))
        if ! (: <"/dev/tcp/127.0.0.1/$port") 2>"$logs/port"; then
            echo "$port"
            return
        fi
    done
    return 1
}

# A requeued task waits until its credential has expired, here 30 s instead of 120.
write_slurm_configuration() {
    local host ports
    host=$(hostname -s)
    ports=("$(free_port)" "$(free_port)" "$(free_port)")
    cat >"$cluster/slurm.conf" <<CONF
ClusterName=hedron
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket,cred_expire=30
CredType=cred/munge
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.%n.pid
SlurmctldLogFile=$cluster/log/slurmctld
SlurmdLogFile=$cluster/log/slurmd.%n
SlurmdParameters=config_overrides
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
MailProg=/bin/true
KillWait=300
MessageTimeout=100
SlurmdTimeout=0
BatchStartTimeout=300
UnkillableStepTimeout=600
MinJobAge=3600
NodeName=node1 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=4
NodeName=node2 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=4
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP LLN=YES
CONF
}

# start_daemon NAME COMMAND...
start_daemon() {
    local name=$1
    shift
    "$@" </dev/null >"$cluster/log/$name.out" 2>&1 &
    cluster_pids+=($!)
}

daemons_run() {
    local daemon
    for daemon in "${cluster_pids[@]}"; do
        kill -0 "$daemon" 2>/dev/null || return 1
    done
}

two_nodes_are_idle() {
    sleep 0.3
    [[ $(sinfo -h -N -o '%N %T' 2>"$logs/sinfo") == $'node1 idle\nnode2 idle' ]]
}

cluster_is_decided() {
    two_nodes_are_idle || ! daemons_run
}

try_to_start_cluster() {
    local node
    mkdir -p "$cluster"/{munge,state,log}
    write_slurm_configuration
    head -c 1024 /dev/urandom >"$cluster/munge/key"
    chmod 400 "$cluster/munge/key"
    start_daemon munged munged --foreground --force --key-file="$cluster/munge/key" \
        --socket="$cluster/munge/socket" --pid-file="$cluster/munge/pid" \
        --log-file="$cluster/log/munged" --seed-file="$cluster/munge/seed"
    wait_until 60 test -S "$cluster/munge/socket" || return 1
    start_daemon slurmctld slurmctld -D -f "$SLURM_CONF"
    for node in node1 node2; do
        start_daemon "slurmd.$node" slurmd -D -N "$node" -f "$SLURM_CONF"
    done
    wait_until 180 cluster_is_decided && daemons_run
}

# Skips the test if the daemons do not start, such as for lack of a permission.
start_cluster() {
    export SLURM_CONF=$cluster/slurm.conf
    try_to_start_cluster ||
        skip "Slurm does not start here: $(grep -r -h -i -m 2 -E 'fatal|error' "$cluster/log" | head -n 4 | tr '\n' ';')"
}

# Processes of the cluster: its daemons, and what they have started. The search itself has nothing of the cluster in its
# arguments and environment.
cluster_processes() {
    printf '%s' "$cluster" | env -i grep -l -a -F -f - /proc/[0-9]*/cmdline /proc/[0-9]*/environ 2>/dev/null |
        cut -d / -f 3 | sort -u | grep -v -x -e "$$" || true
}

no_cluster_processes() {
    [[ -z $(cluster_processes) ]]
}

stop_daemons() {
    local daemon
    for daemon in "${cluster_pids[@]}"; do
        kill "$daemon" 2>/dev/null || true
    done
    for daemon in "${cluster_pids[@]}"; do
        wait_until 60 is_gone "$daemon" || kill -KILL "$daemon" 2>/dev/null || true
        wait "$daemon" 2>/dev/null || true
    done
    cluster_pids=()
}

# Jobs first, because the daemons leave them running. True if nothing had to be killed.
stop_cluster() {
    local process
    if ((${#cluster_pids[@]} > 0)) && daemons_run; then
        scancel --full --user="$(id -un)" 2>"$logs/scancel" || true
        wait_until 60 queue_is_empty || true
    fi
    stop_daemons
    if wait_until 60 no_cluster_processes; then
        return 0
    fi
    for process in $(cluster_processes); do
        echo "left: $process $(tr '\0' ' ' <"/proc/$process/cmdline" 2>/dev/null)" >&2
        kill -KILL "$process" 2>/dev/null || true
    done
    return 1
}

queue_is_empty() {
    local queue
    sleep 0.3
    queue=$(squeue -h -r 2>"$logs/squeue") && [[ -z $queue ]]
}

stop_cluster_at_exit() {
    local last=$?
    set +e
    stop_cluster || last=1
    (exit "$last")
    clean_up
}
trap stop_cluster_at_exit EXIT
