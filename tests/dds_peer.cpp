// A ROS 2 peer of another vendor (eProsima Fast DDS, Fast CDR), which knows nothing of ours: started by dds_peers.py.
//
//     peer DOMAIN NAME
//
// It answers lines on its standard input with lines on its standard output, and tells unasked whom it meets:
//     found TOPIC TYPE USERDATA | lost TOPIC             an endpoint of another participant
//     matched TOPIC COUNT                                one of its own endpoints
//     rounds N         1,000 and more Twists out, each answered by an Odometry of the same number; at most 5 on the way
//     nodes            the names of nodes that were told in ros_discovery_info
//     drive A B C | twist V W | command X | flood N      what a driver sends
//     rubbish N        N bytes that are no Twist
//     clock | odom | still | refused                     what came last: stamp; x, speed; frames of /tf_static; /rosout
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

#include <fastcdr/Cdr.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

using namespace eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::SerializedPayload_t;

std::mutex speaking;
void say(const std::string& line) {
  std::lock_guard<std::mutex> lock(speaking);
  std::cout << line << std::endl;
}

// A message is its bytes; what they mean is read and written with Fast CDR below.
struct Bytes { std::vector<char> data; };

struct Type : TopicDataType {
  explicit Type(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1 << 16;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    auto& bytes = static_cast<Bytes*>(data)->data;
    payload->length = bytes.size();
    payload->encapsulation = CDR_LE;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->data.assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return uint32_t(static_cast<Bytes*>(data)->data.size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

template <class F> std::vector<char> written(F f) {
  std::vector<char> room(4096);
  FastBuffer buffer(room.data(), room.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  f(cdr);
  room.resize(cdr.getSerializedDataLength());
  return room;
}

template <class F> bool read(std::vector<char>& bytes, F f) {
  FastBuffer buffer(bytes.data(), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  try {
    cdr.read_encapsulation();
    f(cdr);
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;
  }
}

struct Header { int32_t sec; uint32_t nanosec; std::string frame; };
Header header(Cdr& cdr) {
  Header h;
  cdr >> h.sec >> h.nanosec >> h.frame;
  return h;
}

struct Odometry { Header head; std::string child; double pose[7], poses[36], twist[6], twists[36]; };
bool odometry(std::vector<char>& bytes, Odometry& o) {
  return read(bytes, [&](Cdr& cdr) {
    o.head = header(cdr);
    cdr >> o.child;
    for (double& x : o.pose) cdr >> x;
    for (double& x : o.poses) cdr >> x;
    for (double& x : o.twist) cdr >> x;
    for (double& x : o.twists) cdr >> x;
  });
}

struct Peer {
  DomainParticipant* participant = nullptr;
  Publisher* publisher = nullptr;
  Subscriber* subscriber = nullptr;

  struct Writes : DataWriterListener {
    void on_publication_matched(DataWriter* writer, const PublicationMatchedStatus& status) override {
      say("matched " + writer->get_topic()->get_name() + " " + std::to_string(status.current_count));
    }
  } writes;

  struct Reads : DataReaderListener {
    std::function<void(std::vector<char>&)> take;
    void on_subscription_matched(DataReader* reader, const SubscriptionMatchedStatus& status) override {
      say("matched " + std::string(reader->get_topicdescription()->get_name()) + " " + std::to_string(status.current_count));
    }
    void on_data_available(DataReader* reader) override {
      Bytes bytes;
      SampleInfo info;
      while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK)
        if (info.valid_data) take(bytes.data);
    }
  };

  Topic* topic(const std::string& name, const std::string& type) {
    TypeSupport support(new Type(type));
    support.register_type(participant);
    if (auto* known = participant->lookup_topicdescription(name)) return static_cast<Topic*>(known);
    return participant->create_topic(name, type, TOPIC_QOS_DEFAULT);
  }
  DataWriter* writer(const std::string& name, const std::string& type) {
    DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().kind = KEEP_ALL_HISTORY_QOS;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return publisher->create_datawriter(topic(name, type), qos, &writes);
  }
  void reader(const std::string& name, const std::string& type, bool latched, std::function<void(std::vector<char>&)> take) {
    DataReaderQos qos = DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.history().kind = KEEP_ALL_HISTORY_QOS;
    if (latched) qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    auto* reads = new Reads;
    reads->take = take;
    subscriber->create_datareader(topic(name, type), qos, reads);
  }
};

struct Meets : DomainParticipantListener {
  void on_publisher_discovery(DomainParticipant*, eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override {
    tell(info.status == eprosima::fastrtps::rtps::WriterDiscoveryInfo::REMOVED_WRITER, info.info);
  }
  void on_subscriber_discovery(DomainParticipant*, eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override {
    tell(info.status == eprosima::fastrtps::rtps::ReaderDiscoveryInfo::REMOVED_READER, info.info);
  }
  template <class Data> void tell(bool lost, const Data& data) {
    std::string user(data.m_qos.m_userData.begin(), data.m_qos.m_userData.end());
    say((lost ? "lost " : "found ") + data.topicName().to_string() + " " + data.typeName().to_string() + " " + user);
  }
};

// What both sides reckon of a number: every field another value, and strings of all lengths, so that nothing is aligned by luck.
double value(int number, int field) { return number * 0.125 + field * 1000.5; }
std::string name(int number) { return std::string(number % 9, 'a' + number % 26); }

int main(int, char** words) {
  const int domain = std::stoi(words[1]);
  const std::string node = words[2];
  DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
  qos.transport().use_builtin_transports = false;  // shared memory is another thing than a network
  qos.transport().user_transports.push_back(std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>());
  const std::string enclave = "enclave=/;";
  qos.user_data().data_vec({enclave.begin(), enclave.end()});
  Meets meets;
  Peer peer;
  peer.participant = DomainParticipantFactory::get_instance()->create_participant(domain, qos, &meets, StatusMask::none());
  peer.publisher = peer.participant->create_publisher(PUBLISHER_QOS_DEFAULT);
  peer.subscriber = peer.participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);

  std::mutex seen;
  std::string nodes, still, refused;
  Header clock{-1, 0, ""};
  Odometry odom{};
  std::atomic<int> answers{0}, equal{0};

  auto* drive = peer.writer("rt/drive", "worldwright_msgs::msg::dds_::Drive_");
  auto* twist = peer.writer("rt/cmd_vel", "geometry_msgs::msg::dds_::Twist_");
  auto* command = peer.writer("rt/command/pull", "std_msgs::msg::dds_::Float64_");
  auto* ping = peer.writer("rt/ping", "geometry_msgs::msg::dds_::Twist_");
  peer.reader("rt/pong", "nav_msgs::msg::dds_::Odometry_", false, [&](std::vector<char>& bytes) {
    Odometry o;
    bool same = odometry(bytes, o) && o.head.sec == answers && o.head.nanosec == uint32_t(answers * 7);
    same = same && o.head.frame == name(answers) && o.child == name(answers + 5);
    int field = 0;
    for (double x : o.pose) same = same && x == value(answers, field++);
    for (double x : o.poses) same = same && x == value(answers, field++);
    for (double x : o.twist) same = same && x == value(answers, field++);
    for (double x : o.twists) same = same && x == value(answers, field++);
    equal += same;
    ++answers;
  });
  peer.reader("rt/clock", "rosgraph_msgs::msg::dds_::Clock_", false, [&](std::vector<char>& bytes) {
    std::lock_guard<std::mutex> lock(seen);
    read(bytes, [&](Cdr& cdr) { cdr >> clock.sec >> clock.nanosec; });
  });
  peer.reader("rt/odom", "nav_msgs::msg::dds_::Odometry_", false, [&](std::vector<char>& bytes) {
    std::lock_guard<std::mutex> lock(seen);
    odometry(bytes, odom);
  });
  peer.reader("rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_", true, [&](std::vector<char>& bytes) {
    std::lock_guard<std::mutex> lock(seen);
    read(bytes, [&](Cdr& cdr) {
      uint32_t count;
      cdr >> count;
      still.clear();
      for (; count; --count) {
        Header h = header(cdr);
        std::string child;
        double number;
        cdr >> child;
        for (int i = 0; i < 7; ++i) cdr >> number;
        still += " " + h.frame + ">" + child;
      }
    });
  });
  peer.reader("rt/rosout", "rcl_interfaces::msg::dds_::Log_", true, [&](std::vector<char>& bytes) {
    std::lock_guard<std::mutex> lock(seen);
    read(bytes, [&](Cdr& cdr) {
      int32_t sec;
      uint32_t nanosec;
      uint8_t level;
      std::string logger, message;
      cdr >> sec >> nanosec >> level >> logger >> message;
      refused += " [" + std::to_string(level) + " " + logger + "] " + message;
    });
  });
  peer.reader("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", true, [&](std::vector<char>& bytes) {
    std::lock_guard<std::mutex> lock(seen);
    read(bytes, [&](Cdr& cdr) {
      uint8_t gid[16];
      uint32_t count, readers, writers;
      for (uint8_t& byte : gid) cdr >> byte;
      cdr >> count;
      for (; count; --count) {
        std::string space, called;
        cdr >> space >> called >> readers;
        for (uint32_t i = 0; i < readers; ++i) for (uint8_t& byte : gid) cdr >> byte;
        cdr >> writers;
        for (uint32_t i = 0; i < writers; ++i) for (uint8_t& byte : gid) cdr >> byte;
        nodes += " " + space + called + ":" + std::to_string(readers) + ":" + std::to_string(writers);
      }
    });
  });
  // Told as rmw_fastrtps_cpp does: which node these endpoints are of.
  DataWriterQos kept = DATAWRITER_QOS_DEFAULT;
  kept.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  auto* graph = peer.publisher->create_datawriter(
      peer.topic("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"), kept, &peer.writes);
  auto gid = [](Cdr& cdr, const eprosima::fastrtps::rtps::GUID_t& guid) {
    for (auto byte : guid.guidPrefix.value) cdr << uint8_t(byte);
    for (auto byte : guid.entityId.value) cdr << uint8_t(byte);
  };
  Bytes told{written([&](Cdr& cdr) {
    gid(cdr, peer.participant->guid());
    cdr << uint32_t(1) << std::string("/") << node << uint32_t(0) << uint32_t(3);
    for (auto* own : {drive, twist, command}) gid(cdr, own->guid());
  })};
  graph->write(&told);

  auto numbers = [](std::initializer_list<double> some) {
    return Bytes{written([&](Cdr& cdr) { for (double x : some) cdr << x; })};
  };
  say("ready");
  std::string line, word;
  while (std::getline(std::cin, line)) {
    std::istringstream rest(line);
    rest >> word;
    // istream reads no `nan`.
    auto number = [&] { std::string text = "0"; rest >> text; return std::stod(text); };
    if (word == "rounds") {
      int count = int(number()), sent = 0, waited = 0, before = 0;
      while (answers < count && waited < 200000) {  // some 20 s in which nothing comes
        if (before != answers) before = answers, waited = 0;
        if (sent < count && sent - answers < 5) {
          Bytes bytes = numbers({value(sent, 0), value(sent, 1), value(sent, 2), value(sent, 3), value(sent, 4), value(sent, 5)});
          ping->write(&bytes);
          ++sent;
        } else {
          std::this_thread::sleep_for(std::chrono::microseconds(100));
          ++waited;
        }
      }
      say("rounds " + std::to_string(sent) + " " + std::to_string(answers) + " " + std::to_string(equal));
    } else if (word == "drive") {
      double a = number(), b = number(), c = number();
      Bytes bytes = numbers({a, b, c});
      drive->write(&bytes);
    } else if (word == "twist") {
      double v = number(), w = number();
      Bytes bytes = numbers({v, 0, 0, 0, 0, w});
      twist->write(&bytes);
    } else if (word == "command" || word == "flood") {
      int count = word == "flood" ? int(number()) : 1;
      Bytes bytes = numbers({word == "flood" ? 0.0 : number()});
      for (int i = 0; i < count; ++i) command->write(&bytes);
    } else if (word == "rubbish") {
      int count = int(number());
      Bytes bytes{written([&](Cdr& cdr) { for (int i = 0; i < count; ++i) cdr << uint8_t(i); })};
      twist->write(&bytes);
    } else {
      std::lock_guard<std::mutex> lock(seen);
      std::ostringstream out;
      out.precision(17);
      if (word == "nodes") out << nodes;
      else if (word == "still") out << still;
      else if (word == "refused") out << refused;
      else if (word == "clock") out << " " << clock.sec << " " << clock.nanosec;
      else out << " " << odom.child << " " << odom.pose[0] << " " << odom.twist[0];
      say(word + out.str());
    }
  }
  peer.participant->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(peer.participant);  // it says that it leaves
  return 0;
}
